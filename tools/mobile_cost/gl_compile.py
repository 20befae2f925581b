"""Compiles programs of OpenGL ES with whatever driver EGL finds, on no screen: gl_compile.py FOLDER…

Each FOLDER has vertex.glsl and fragment.glsl. Prints, on stdout, "gl: RENDERER | VERSION" and around each program
"gl: begin FOLDER" and "gl: end FOLDER"; between them what the driver says about it as KHR_debug messages, and, if it is
told by its environment to print listings there, those. Stands alone: it runs under another C library, or another processor
that is emulated.
"""

import ctypes
import os
import sys

EGL_NONE = 0x3038
EGL_OPENGL_ES_API = 0x30A0
EGL_CONTEXT_MAJOR_VERSION = 0x3098
EGL_CONTEXT_MINOR_VERSION = 0x30FB
EGL_CONTEXT_OPENGL_DEBUG = 0x31B0
EGL_PLATFORM_SURFACELESS_MESA = 0x31DD
EGL_RENDERABLE_TYPE = 0x3040
EGL_OPENGL_ES2_BIT = 0x0004
EGL_SURFACE_TYPE = 0x3033
EGL_PBUFFER_BIT = 0x0001
GL_VERTEX_SHADER, GL_FRAGMENT_SHADER = 0x8B31, 0x8B30
GL_COMPILE_STATUS, GL_LINK_STATUS = 0x8B81, 0x8B82
GL_RENDERER, GL_VERSION = 0x1F01, 0x1F02
GL_DEBUG_OUTPUT, GL_DEBUG_OUTPUT_SYNCHRONOUS, GL_DONT_CARE = 0x92E0, 0x8242, 0x1100

pointer, integer, unsigned = ctypes.c_void_p, ctypes.c_int, ctypes.c_uint
DebugCallback = ctypes.CFUNCTYPE(None, unsigned, unsigned, unsigned, unsigned, integer, ctypes.c_char_p, pointer)

egl = ctypes.CDLL("libEGL.so.1")
egl.eglGetProcAddress.restype = pointer
egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]


def function(name, result, *arguments):
    address = egl.eglGetProcAddress(name.encode())
    if not address:
        sys.exit(f"gl: the driver has no {name}")
    return ctypes.CFUNCTYPE(result, *arguments)(address)


def say(text):
    print(text, flush=True)


def make_context():
    display = function("eglGetPlatformDisplayEXT", pointer, unsigned, pointer, pointer)(EGL_PLATFORM_SURFACELESS_MESA, None, None)
    if not function("eglInitialize", unsigned, pointer, pointer, pointer)(display, None, None):
        sys.exit("gl: EGL finds no driver")
    function("eglBindAPI", unsigned, unsigned)(EGL_OPENGL_ES_API)
    config, count = pointer(), integer()
    wanted = (integer * 5)(EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_NONE)
    choose = function("eglChooseConfig", unsigned, pointer, pointer, pointer, integer, pointer)
    choose(display, wanted, ctypes.byref(config), 1, ctypes.byref(count))
    create = function("eglCreateContext", pointer, pointer, pointer, pointer, pointer)
    attributes = (integer * 7)(EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_CONTEXT_OPENGL_DEBUG, 1, EGL_NONE)
    context = create(display, config, None, attributes)
    if not context or not function("eglMakeCurrent", unsigned, pointer, pointer, pointer, pointer)(display, None, None, context):
        sys.exit("gl: the driver makes no context of OpenGL ES 3.0")


def checked(handle, status, get, get_log):
    done = integer()
    get(handle, status, ctypes.byref(done))
    if not done.value:
        log = ctypes.create_string_buffer(8192)
        get_log(handle, len(log), None, log)
        sys.exit("gl: refused: " + log.value.decode(errors="replace").replace("\n", " "))
    return handle


def compile_shader(kind, path):
    with open(path, "rb") as file:
        source = ctypes.c_char_p(file.read())
    shader = function("glCreateShader", unsigned, unsigned)(kind)
    function("glShaderSource", None, unsigned, integer, pointer, pointer)(shader, 1, ctypes.byref(source), None)
    function("glCompileShader", None, unsigned)(shader)
    return checked(
        shader,
        GL_COMPILE_STATUS,
        function("glGetShaderiv", None, unsigned, unsigned, pointer),
        function("glGetShaderInfoLog", None, unsigned, integer, pointer, ctypes.c_char_p),
    )


def link(folder):
    program = function("glCreateProgram", unsigned)()
    attach = function("glAttachShader", None, unsigned, unsigned)
    attach(program, compile_shader(GL_VERTEX_SHADER, os.path.join(folder, "vertex.glsl")))
    attach(program, compile_shader(GL_FRAGMENT_SHADER, os.path.join(folder, "fragment.glsl")))
    function("glLinkProgram", None, unsigned)(program)
    checked(
        program,
        GL_LINK_STATUS,
        function("glGetProgramiv", None, unsigned, unsigned, pointer),
        function("glGetProgramInfoLog", None, unsigned, integer, pointer, ctypes.c_char_p),
    )
    function("glFinish", None)()


@DebugCallback
def report(_source, _kind, _number, _severity, length, message, _user):
    say("gl: said " + message[:length].decode(errors="replace"))


def main(folders):
    make_context()
    text = function("glGetString", ctypes.c_char_p, unsigned)
    say(f"gl: {text(GL_RENDERER).decode()} | {text(GL_VERSION).decode()}")
    enable = function("glEnable", None, unsigned)
    enable(GL_DEBUG_OUTPUT)
    enable(GL_DEBUG_OUTPUT_SYNCHRONOUS)
    control = function("glDebugMessageControlKHR", None, unsigned, unsigned, unsigned, integer, pointer, ctypes.c_ubyte)
    control(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, None, 1)
    function("glDebugMessageCallbackKHR", None, DebugCallback, pointer)(report, None)
    for folder in folders:
        say(f"gl: begin {folder}")
        link(folder)
        say(f"gl: end {folder}")


if __name__ == "__main__":
    main(sys.argv[1:])
