/* Where a picture's file says what it was made from. */
#ifndef TL_IMAGE_RECORD_H
#define TL_IMAGE_RECORD_H

/* The name of the attribute or text chunk. */
#define TL_IMAGE_RECORD_NAME "tilelight:record"

#endif
