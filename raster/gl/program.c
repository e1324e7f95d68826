#include "program.h"

#include "embedded_shaders.h"

#include <stdio.h>
#include <string.h>

static const char *const macros[TL_FEATURE_COUNT] = {
#define FEATURE_MACRO(name, macro) [name] = macro,
    TL_FEATURES(FEATURE_MACRO)
#undef FEATURE_MACRO
};

static const struct {
    const char *name, *fragment;
    unsigned features; /* what the pass looks at */
} passes[TL_PASS_COUNT] = {
    [TL_DEPTH_PASS] = {"depth", tl_depth_frag, 1u << TL_HAS_BASE_COLOR | 1u << TL_ALPHA_TEST},
    [TL_SURFACE_PASS] = {"surface", tl_surface_frag, (1u << TL_FEATURE_COUNT) - 1u},
};

/* 0 on failure. `prefix`: version and macros; texts may be NULL. */
static GLuint compile(const tl_gl *gl,
                      GLenum stage,
                      const char *prefix,
                      const char *first,
                      const char *second,
                      tl_error *err)
{
    const char *const texts[] = {prefix, tl_interface_h, "\n#line 1\n", first, second};
    GLint done = 0;
    const GLuint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, 5, texts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done)
        return shader;
    char log[2048] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->DeleteShader(shader);
    tl_fail(err, TL_ERR_DEVICE, "OpenGL refuses a shader: %s", log);
    return 0;
}

static tl_status link_program(
    const tl_gl *gl, GLuint vertex, GLuint fragment, GLuint *out, tl_error *err)
{
    GLint done = 0;
    const GLuint program = gl->CreateProgram();
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &done);
    if (!done) {
        char log[2048] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        return tl_fail(err, TL_ERR_DEVICE, "OpenGL cannot link shaders: %s", log);
    }
    *out = program;
    return TL_OK;
}

tl_status tl_program_for(const tl_gl *gl,
                         tl_programs *programs,
                         tl_pass pass,
                         unsigned features,
                         GLuint *out,
                         tl_error *err)
{
    tl_status status = TL_ERR_DEVICE;
    char prefix[512];

    if (!(features & 1u << TL_ALPHA_TEST) && pass == TL_DEPTH_PASS)
        features = 0;
    features &= passes[pass].features;
    GLuint *const made = &programs->made[pass][features];
    if (*made) {
        *out = *made;
        return TL_OK;
    }
    size_t length = (size_t)snprintf(prefix, sizeof prefix, "#version 450 core\n");
    for (int i = 0; i < TL_FEATURE_COUNT; i++)
        if (features & 1u << i)
            length += (size_t)snprintf(prefix + length, sizeof prefix - length, "#define %s\n",
                                       macros[i]);
    const GLuint vertex = compile(gl, GL_VERTEX_SHADER, prefix, tl_geometry_vert, "", err);
    const GLuint fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, prefix, tl_lookup_glsl,
                                             passes[pass].fragment, err)
                                   : 0;
    if (vertex && fragment)
        status = link_program(gl, vertex, fragment, made, err);
    /* A program keeps its shaders as long as it needs them. */
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    if (status == TL_OK)
        *out = *made;
    return status;
}
