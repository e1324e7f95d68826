/* OpenGL 4.5 core on OSMesa: a context of one's own, and its functions in a table.
 *
 * Loaders look for a window system that is not here, so the functions come from
 * OSMesaGetProcAddress. */
#ifndef TL_GL_H
#define TL_GL_H

#include "tilelight/error.h"

#include <GL/glcorearb.h>
#include <stddef.h>

/* X(name without gl, the type's name) */
#define TL_GL_FUNCTIONS(X)                                                  \
    X(AttachShader, ATTACHSHADER)                                           \
    X(BindFramebuffer, BINDFRAMEBUFFER)                                     \
    X(BindSampler, BINDSAMPLER)                                             \
    X(BindTextureUnit, BINDTEXTUREUNIT)                                     \
    X(BindVertexArray, BINDVERTEXARRAY)                                     \
    X(BlendFunc, BLENDFUNC)                                                 \
    X(CheckNamedFramebufferStatus, CHECKNAMEDFRAMEBUFFERSTATUS)             \
    X(ClampColor, CLAMPCOLOR)                                               \
    X(ClearNamedFramebufferfi, CLEARNAMEDFRAMEBUFFERFI)                     \
    X(ClearNamedFramebufferfv, CLEARNAMEDFRAMEBUFFERFV)                     \
    X(ClearTexImage, CLEARTEXIMAGE)                                         \
    X(ClipControl, CLIPCONTROL)                                             \
    X(ColorMask, COLORMASK)                                                 \
    X(CompileShader, COMPILESHADER)                                         \
    X(CreateBuffers, CREATEBUFFERS)                                         \
    X(CreateFramebuffers, CREATEFRAMEBUFFERS)                               \
    X(CreateProgram, CREATEPROGRAM)                                         \
    X(CreateRenderbuffers, CREATERENDERBUFFERS)                             \
    X(CreateSamplers, CREATESAMPLERS)                                       \
    X(CreateShader, CREATESHADER)                                           \
    X(CreateTextures, CREATETEXTURES)                                       \
    X(CreateVertexArrays, CREATEVERTEXARRAYS)                               \
    X(CullFace, CULLFACE)                                                   \
    X(DeleteShader, DELETESHADER)                                           \
    X(DepthFunc, DEPTHFUNC)                                                 \
    X(DepthMask, DEPTHMASK)                                                 \
    X(Disable, DISABLE)                                                     \
    X(DrawArrays, DRAWARRAYS)                                               \
    X(DrawArraysInstancedBaseInstance, DRAWARRAYSINSTANCEDBASEINSTANCE)     \
    X(DrawElements, DRAWELEMENTS)                                           \
    X(DrawElementsInstancedBaseInstance, DRAWELEMENTSINSTANCEDBASEINSTANCE) \
    X(Enable, ENABLE)                                                       \
    X(EnableVertexArrayAttrib, ENABLEVERTEXARRAYATTRIB)                     \
    X(Finish, FINISH)                                                       \
    X(FrontFace, FRONTFACE)                                                 \
    X(GenerateTextureMipmap, GENERATETEXTUREMIPMAP)                         \
    X(GetError, GETERROR)                                                   \
    X(GetIntegerv, GETINTEGERV)                                             \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                                 \
    X(GetProgramiv, GETPROGRAMIV)                                           \
    X(GetShaderInfoLog, GETSHADERINFOLOG)                                   \
    X(GetShaderiv, GETSHADERIV)                                             \
    X(GetString, GETSTRING)                                                 \
    X(LinkProgram, LINKPROGRAM)                                             \
    X(NamedBufferStorage, NAMEDBUFFERSTORAGE)                               \
    X(NamedBufferSubData, NAMEDBUFFERSUBDATA)                               \
    X(NamedFramebufferDrawBuffers, NAMEDFRAMEBUFFERDRAWBUFFERS)             \
    X(NamedFramebufferReadBuffer, NAMEDFRAMEBUFFERREADBUFFER)               \
    X(NamedFramebufferRenderbuffer, NAMEDFRAMEBUFFERRENDERBUFFER)           \
    X(NamedFramebufferTexture, NAMEDFRAMEBUFFERTEXTURE)                     \
    X(NamedRenderbufferStorage, NAMEDRENDERBUFFERSTORAGE)                   \
    X(PixelStorei, PIXELSTOREI)                                             \
    X(ReadPixels, READPIXELS)                                               \
    X(SamplerParameteri, SAMPLERPARAMETERI)                                 \
    X(ShaderSource, SHADERSOURCE)                                           \
    X(StencilFunc, STENCILFUNC)                                             \
    X(StencilOp, STENCILOP)                                                 \
    X(TextureStorage2D, TEXTURESTORAGE2D)                                   \
    X(TextureSubImage2D, TEXTURESUBIMAGE2D)                                 \
    X(Uniform1ui, UNIFORM1UI)                                               \
    X(Uniform1f, UNIFORM1F)                                                 \
    X(Uniform1fv, UNIFORM1FV)                                               \
    X(Uniform1iv, UNIFORM1IV)                                               \
    X(Uniform3fv, UNIFORM3FV)                                               \
    X(Uniform4fv, UNIFORM4FV)                                               \
    X(UniformMatrix3fv, UNIFORMMATRIX3FV)                                   \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)                                   \
    X(UniformMatrix4x3fv, UNIFORMMATRIX4X3FV)                               \
    X(UseProgram, USEPROGRAM)                                               \
    X(VertexArrayAttribBinding, VERTEXARRAYATTRIBBINDING)                   \
    X(VertexArrayAttribFormat, VERTEXARRAYATTRIBFORMAT)                     \
    X(VertexArrayAttribIFormat, VERTEXARRAYATTRIBIFORMAT)                   \
    X(VertexArrayBindingDivisor, VERTEXARRAYBINDINGDIVISOR)                 \
    X(VertexArrayElementBuffer, VERTEXARRAYELEMENTBUFFER)                   \
    X(VertexArrayVertexBuffer, VERTEXARRAYVERTEXBUFFER)                     \
    X(VertexAttrib4f, VERTEXATTRIB4F)                                       \
    X(Viewport, VIEWPORT)

typedef struct tl_gl {
#define TL_GL_MEMBER(name, type) PFNGL##type##PROC name;
    TL_GL_FUNCTIONS(TL_GL_MEMBER)
#undef TL_GL_MEMBER
    void *context;          /* OSMesa's; everything that GL made goes with it */
    unsigned char pixel[4]; /* OSMesa wants a window to draw to; targets are our own */
} tl_gl;

/* Makes a context and makes it current on this thread. The caller releases *out with tl_gl_close,
 * on the same thread. Fails with TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_gl_open(tl_gl **out, tl_error *err);

/* Makes an open context current on this thread, where another one may have become it since. Fails
 * with TL_ERR_DEVICE. */
tl_status tl_gl_use(tl_gl *gl, tl_error *err);

/* Accepts NULL. */
void tl_gl_close(tl_gl *gl);

/* TL_ERR_DEVICE or TL_ERR_MEMORY where GL has reported an error since the last call; `what` was
 * being done. */
tl_status tl_gl_check(const tl_gl *gl, const char *what, tl_error *err);

#endif
