#include "number_json.h"

#include <math.h>
#include <stdio.h>

json_t *number_json(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *number_json_array(const float *values, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, number_json((double)values[i]));
    return array;
}

tl_status number_json_print(json_t *report, tl_error *err)
{
    /* 9 digits tell every float from its neighbours. */
    const size_t flags = JSON_INDENT(2) | JSON_REAL_PRECISION(9);
    if (!report)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the report");
    const int failed = json_dumpf(report, stdout, flags) != 0 || putchar('\n') == EOF;
    json_decref(report);
    return failed ? tl_fail(err, TL_ERR_WRITE, "standard output could not be written") : TL_OK;
}
