/* A folder of its own for the OpenCL driver of this process.
 *
 * PoCL compiles through files, in a folder that all its processes share: it grows without bound,
 * nothing in it is checked before it is run, and without write access to it there is no device at
 * all. So each process lends PoCL an empty folder on a local disk and removes it at the end; what
 * is worth keeping is in our own cache (program_cache.h). A folder that a killed process left
 * behind is removed by a later one.
 *
 * POCL_CACHE_DIR in the user's environment is the user's choice, and is left alone. */
#ifndef TL_DRIVER_FOLDER_H
#define TL_DRIVER_FOLDER_H

/* Before the first call to OpenCL: makes the folder, once per process, and names it in the
 * environment. XDG_RUNTIME_DIR and /dev/shm (PoCL waits for the disk with each of ten files that it
 * unpacks, which memory makes short), TMPDIR, /tmp and the program cache are tried in turn, for one
 * that can be written to, has room, and lets code run. Where none does, PoCL is left to its own
 * ways. Changes the environment: not while another thread reads it. */
void tl_driver_folder_lend(void);

/* After the driver has started, which is when it reads the environment: takes the name out again,
 * so that programs started from here have folders of their own. */
void tl_driver_folder_forget(void);

#endif
