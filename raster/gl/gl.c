#include "gl.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* <GL/osmesa.h> includes the compatibility header, which does not go with the core one. */
#define __gl_h_ 1
#define GLAPIENTRY APIENTRY
#include <GL/osmesa.h>

/* Names and where their addresses go in tl_gl. */
static const struct {
    const char *name;
    size_t offset;
} functions[] = {
#define FUNCTION(name, type) {"gl" #name, offsetof(tl_gl, name)},
    TL_GL_FUNCTIONS(FUNCTION)
#undef FUNCTION
};

static tl_status load_functions(tl_gl *gl, tl_error *err)
{
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        const OSMESAproc address = OSMesaGetProcAddress(functions[i].name);
        if (!address)
            return tl_fail(err, TL_ERR_DEVICE, "OSMesa has no %s", functions[i].name);
        memcpy((char *)gl + functions[i].offset, &address, sizeof address);
    }
    return TL_OK;
}

tl_status tl_gl_use(tl_gl *gl, tl_error *err)
{
    if (!OSMesaMakeCurrent(gl->context, gl->pixel, GL_UNSIGNED_BYTE, 1, 1))
        return tl_fail(err, TL_ERR_DEVICE, "OSMesa cannot make an OpenGL context current");
    return TL_OK;
}

tl_status tl_gl_open(tl_gl **out, tl_error *err)
{
    static const int wanted[] = {OSMESA_FORMAT,
                                 OSMESA_RGBA,
                                 OSMESA_DEPTH_BITS,
                                 0,
                                 OSMESA_STENCIL_BITS,
                                 0,
                                 OSMESA_ACCUM_BITS,
                                 0,
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 4,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 5,
                                 0};
    tl_gl *gl = calloc(1, sizeof *gl);
    if (!gl)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for an OpenGL context");
    tl_status status = load_functions(gl, err);
    if (status == TL_OK) {
        gl->context = OSMesaCreateContextAttribs(wanted, NULL);
        status = gl->context
                     ? tl_gl_use(gl, err)
                     : tl_fail(err, TL_ERR_DEVICE,
                               "OSMesa gives no OpenGL 4.5 core context; Mesa 22.3 does");
    }
    if (status != TL_OK) {
        tl_gl_close(gl);
        return status;
    }
    *out = gl;
    return TL_OK;
}

void tl_gl_close(tl_gl *gl)
{
    if (!gl)
        return;
    if (gl->context)
        OSMesaDestroyContext(gl->context);
    free(gl);
}

tl_status tl_gl_check(const tl_gl *gl, const char *what, tl_error *err)
{
    const GLenum code = gl->GetError();
    if (code == GL_NO_ERROR)
        return TL_OK;
    while (gl->GetError() != GL_NO_ERROR) /* one flag per kind; the first tells most */
        ;
    if (code == GL_OUT_OF_MEMORY)
        return tl_fail(err, TL_ERR_MEMORY, "OpenGL: out of memory while %s", what);
    return tl_fail(err, TL_ERR_DEVICE, "OpenGL: error 0x%04x while %s", code, what);
}
