"""Shaders in which everything that is mediump is a half float, as on a phone.

Software drivers compute mediump with 32 bits. Here what is mediump goes through packHalf2x16: what samplers that are
mediump give, and sums and products of it. What has no qualifier is highp: Godot 4.6 writes it so for OpenGL ES
(drivers/gles3/shader_gles3.cpp, "precision highp float") and to SPIR-V without RelaxedPrecision.
"""

import re

NAME = "half_of_phones.gdshaderinc"
INCLUDE = f'#include "res://{NAME}"\n'
FUNCTIONS = """#ifndef LOBELIGHT_HALF_OF_PHONES
#define LOBELIGHT_HALF_OF_PHONES

highp vec4 half_of_phones(highp vec4 value)
{
	return vec4(unpackHalf2x16(packHalf2x16(value.xy)), unpackHalf2x16(packHalf2x16(value.zw)));
}

highp float half_of_phones_1(highp float value)
{
	return unpackHalf2x16(packHalf2x16(vec2(value))).x;
}

#endif
"""

SAMPLER = re.compile(r"\buniform mediump sampler\w+ (\w+)")
LOCAL = re.compile(r"\bmediump (?:float|vec[234]) (\w+) = ")
COMMENT = re.compile(r"//[^\n]*")


class UnknownForm(Exception):
    """A use of mediump that this file does not know."""


def samplers(texts):
    names = {name for text in texts for name in SAMPLER.findall(text)}
    if not names:
        raise UnknownForm("no shader has a mediump sampler")
    return names


def wrap_fetches(text, names):
    """half_of_phones() around each fetch from one of these samplers."""
    call = re.compile(rf"\btexture(?:Lod|Grad)?\((?:{'|'.join(sorted(names))}),")
    done, rest = "", text
    while match := call.search(rest):
        depth, end = 0, match.start()
        while True:
            depth += {"(": 1, ")": -1}.get(rest[end], 0)
            end += 1
            if depth == 0 and rest[end - 1] == ")":
                break
        done += rest[: match.start()] + f"half_of_phones({rest[match.start() : end]})"
        rest = rest[end:]
    return done + rest


def wrap_arithmetic(text, names):
    """half_of_phones_1() around sums and products of components of mediump variables and of constants."""
    if not names:
        return text
    component = rf"\b(?:{'|'.join(sorted(names))})\.[xyzwrgba]\b|half_of_phones_1\((?:[^()]|\([^()]*\))*\)"
    atom = rf"(?:{component}|(?<![\w.])\d+\.\d+(?![\w.]))"
    operation = re.compile(rf"({atom}) ([-+*/]) ({atom})")
    while match := next((m for m in operation.finditer(text) if to_be_wrapped(m, component)), None):
        text = f"{text[: match.start()]}half_of_phones_1({match.group(0)}){text[match.end() :]}"
    return text


def to_be_wrapped(match, component):
    """Whether something in it is mediump and it has not been wrapped."""
    return re.search(component, match.group(0)) and not match.string[: match.start()].endswith("half_of_phones_1(")


def round_mediump(text, names):
    """The shader with what is mediump rounded; `names` are the samplers of all files."""
    code = COMMENT.sub("", text)
    if code.count("mediump") != len(SAMPLER.findall(code)) + len(LOCAL.findall(code)):
        raise UnknownForm("a shader uses mediump in a way that ./dev stability cannot round")
    changed = wrap_arithmetic(wrap_fetches(code, names), set(LOCAL.findall(code)))
    if changed == code or changed.lstrip().startswith("shader_type"):
        return changed
    return INCLUDE + changed


def change_of(shaders):
    """change(name, text) for projects.copy_shaders, for these shaders."""
    names = samplers(path.read_text(encoding="utf-8") for path in shaders if path.suffix == ".gdshaderinc")
    return lambda _name, text: round_mediump(text, names)
