#include "tilelight/error.h"

#include <stdarg.h>
#include <stdio.h>

tl_status tl_fail(tl_error *err, tl_status status, const char *format, ...)
{
    if (err) {
        va_list args;
        va_start(args, format);
        vsnprintf(err->message, sizeof err->message, format, args);
        va_end(args);
        err->status = status;
    }
    return status;
}

int tl_exit_status(tl_status status)
{
    static const int exits[] = {
#define TL_STATUS_EXIT(name, exit_status, meaning) [name] = exit_status,
        TL_STATUSES(TL_STATUS_EXIT)
#undef TL_STATUS_EXIT
    };
    return exits[status];
}
