/* Claims as part of a study's JSON. */
#ifndef TL_STUDY_CLAIMS_JSON_H
#define TL_STUDY_CLAIMS_JSON_H

#include "claims.h"

#include <jansson.h>

/* An array of those that are measured. A new reference; NULL out of memory. */
json_t *tl_claims_json(const tl_claim_figures claims[TL_CLAIM_COUNT]);

/* What was written; claims that this program does not know are left out. NULL, or no array: none. */
void tl_claims_of_json(const json_t *array, tl_claim_figures claims[TL_CLAIM_COUNT]);

#endif
