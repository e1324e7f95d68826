#include "shaders.h"

#include "try.h"

static tl_status compile(
    const tl_gl *gl, GLenum stage, const char *const texts[], GLuint *out, tl_error *err)
{
    GLint done = 0;
    GLsizei count = 0;
    while (texts[count])
        count++;
    *out = gl->CreateShader(stage);
    gl->ShaderSource(*out, count, texts, NULL);
    gl->CompileShader(*out);
    gl->GetShaderiv(*out, GL_COMPILE_STATUS, &done);
    if (done)
        return TL_OK;
    char log[2048] = "";
    gl->GetShaderInfoLog(*out, sizeof log, NULL, log);
    return tl_fail(err, TL_ERR_DEVICE, "OpenGL refuses a shader: %s", log);
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

tl_status tl_shaders_link(const tl_gl *gl,
                          const char *const vertex[],
                          const char *const fragment[],
                          GLuint *out,
                          tl_error *err)
{
    tl_status status = TL_OK;
    GLuint shaders[2] = {0, 0};
    TRY(compile(gl, GL_VERTEX_SHADER, vertex, &shaders[0], err));
    TRY(compile(gl, GL_FRAGMENT_SHADER, fragment, &shaders[1], err));
    TRY(link_program(gl, shaders[0], shaders[1], out, err));
done:
    /* A program keeps its shaders as long as it needs them. */
    gl->DeleteShader(shaders[0]);
    gl->DeleteShader(shaders[1]);
    return status;
}
