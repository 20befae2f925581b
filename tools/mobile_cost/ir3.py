"""Reads the listings that Mesa's ir3 compiler prints for Adreno GPUs (IR3_SHADER_DEBUG=vs,fs).

A listing is a shader's instructions and then the compiler's own statistics. What is counted from the instructions has to
equal what the compiler says it emitted, in every category; a listing that does not, because another thread wrote between
its lines or because the notation has changed, is refused (`ListingError`).

How it counts (src/freedreno/ir3/ir3.c, ir3_collect_info): an instruction takes 1 + (rptN) + (nopN) issue slots: repeated,
and with nops behind it; those that move several numbers at once, as many as the moves. Statistics are over the shader proper and its preamble, which runs once a draw and not once a
pixel. `Shader.once()` takes each instruction once, `Shader.weighted()` as often as a pixel runs it: instructions of a
loop times the loop's trips, which are known if the loop counts in constants; see `trips_of`.
"""

import dataclasses
import re

CATEGORIES = ("flow", "move", "alu", "mad", "special", "texture", "memory", "barrier")
# ir3's categories 0 to 7, by the part of the name before the first dot (src/freedreno/isa/ir3-cat*.xml).
_NAMES = (
    "nop end ret emit cut chmask chsh flow_rev br brao braa brac bany ball brax jump call kill demote bkt stks stkr xset"
    " xclr getone getlast shps shpe predt predf prede",
    "mov mova mova1 movmsk movs cov swz gat sct",
    "add sub min max mul mull sign cmps absneg cmpv floor ceil rndne rndaz trunc and or not xor mgen getbit setrm cbits shl"
    " shr ashr bary flat shb msad clz bfrev",
    "mad madsh shrm shlm shrg shlg andg sel sad dp2acc dp4acc wmm",
    "rcp rsq log2 exp2 sin cos sqrt hrsq hlog2 hexp2",
    "isam isaml isamm sam samb saml samgq getlod conv convm getsize getbuf getpos getinfo dsx dsy gather4r gather4g"
    " gather4b gather4a samgp0 samgp1 samgp2 samgp3 dsxpp dsypp rgetpos rgetinfo brcst quad_shuffle tcinv",
    "ldg ldl ldp stg stl stp ldib g2l l2g ldlw stlw resfmt resinfo atomic ldgb stgb stib ldc ldlv getspid getwid getfiberid"
    " stc stsc isspam ldunifa",
    "bar fence sleep icinv dccln dcinv dcflu ccinv lock unlock alias",
)
CATEGORY_OF = {name: category for category, names in enumerate(_NAMES) for name in names.split()}
# Instructions that move several numbers at once take as long as several moves.
_MOVES = {"swz": 2, "gat": 4, "sct": 4}
# Texture instructions that read texels.
FETCHES = re.compile(r"(isam|isaml|isamm|sam|samb|saml|gather4[rgba]|samgp[0-3])\.?")

_HEADER = re.compile(r"Native code for (?:un)?named (\w+) shader")
_LABEL = re.compile(r"(l\d+):$")
_FLAGS = re.compile(r"(?:\([^()]*\)\s*)*")
_END = re.compile(r"; (\w+) prog (\d+)/(\d+): (\d+) max_waves")
_INPUT = re.compile(r"@in\((h?)r(\d+)\.([xyzw])\).*wrmask=0x(\w+)")
_REGISTER = re.compile(r"(\(r\))?(?<![\w.])(h?)r(\d+)\.([xyzw])")
# Registers from here on are shared by a wave's threads, or none at all.
_SHARED = 48
_PREFIX = "MESA: info: "


class ListingError(Exception):
    """Says in one sentence what of a listing is not as it should be."""


@dataclasses.dataclass
class Instruction:
    name: str  # with its suffixes, as "mad.f32"
    category: int
    repeat: int  # 0 for an instruction that runs once
    nops: int  # behind it
    text: str  # with its operands, without its flags
    target: str = ""  # the label it jumps to

    @property
    def issues(self):
        """Of its own category."""
        return _MOVES.get(self.name.split(".")[0], 1) + self.repeat

    @property
    def slots(self):
        return self.issues + self.nops


@dataclasses.dataclass
class Counts:
    """Issue slots, of which nops; instructions by category; texture fetches."""

    slots: float = 0
    nops: float = 0
    fetches: float = 0
    categories: list = dataclasses.field(default_factory=lambda: [0] * len(CATEGORIES))

    def add(self, instruction, times=1):
        self.slots += times * instruction.slots
        if instruction.name == "nop":
            self.nops += times * instruction.slots
        else:
            self.nops += times * instruction.nops
        self.categories[instruction.category] += times * instruction.issues
        self.categories[0] += times * instruction.nops
        if FETCHES.match(instruction.name):
            self.fetches += times


@dataclasses.dataclass
class Loop:
    first: int  # index of the first instruction
    last: int  # of the jump back
    trips: int | None  # None if the listing does not tell


@dataclasses.dataclass
class Shader:
    stage: str  # "FRAG", "VERT", or "BVERT", the vertex shader that only bins
    program: int
    variant: int
    instructions: list
    labels: dict
    inputs: list  # (half, register, component, how many components) of what is there at the start
    prefetches: int  # texture fetches that the GPU makes before the shader starts; no instructions
    statistics: dict  # the compiler's own

    def preamble_end(self):
        """Index of the first instruction behind the preamble."""
        return next((i + 1 for i, x in enumerate(self.instructions) if x.name == "shpe"), 0)

    def loops(self):
        return find_loops(self.instructions, self.labels)

    def once(self, start=0):
        counts = Counts()
        for instruction in self.instructions[start:]:
            counts.add(instruction)
        return counts

    def weighted(self):
        """What a pixel runs: without the preamble, loops by their trips (those unknown once)."""
        counts, loops = Counts(), self.loops()
        for i in range(self.preamble_end(), len(self.instructions)):
            times = 1
            for loop in loops:
                if loop.first <= i <= loop.last:
                    times *= loop.trips or 1
            counts.add(self.instructions[i], times)
        return counts


    def registers(self):
        """(full, half) registers that the instructions name: vectors of four numbers of 32 and of 16 bits."""
        last = {False: -1, True: -1}
        # The targets of alias are names, not registers.
        aliases = {x.text.split()[1].rstrip(",") for x in self.instructions if x.name.startswith("alias")}
        found = list(self.inputs)
        for instruction in self.instructions:
            found += registers_of(instruction, aliases)
        for half, register, component, count in found:
            if register < _SHARED:
                last[half] = max(last[half], 4 * register + component + count - 1)
        return last[False] // 4 + 1, last[True] // 4 + 1

    def check(self):
        """Raises ListingError unless what is counted is what the compiler says."""
        own, said = self.once(self.preamble_end()), self.statistics
        for what, counted, wanted in (
            ("issue slots", own.slots, said["instructions"]),
            ("nops", own.nops, said["nops"]),
            ("instructions by category", own.categories, said["categories"]),
            ("loops", len(self.loops()), said["loops"]),
        ):
            if counted != wanted:
                raise ListingError(f"{self.stage} {self.program}: {counted} {what} were found, {wanted} were compiled")
        full, half = self.registers()
        # One file for both from Adreno 6xx on: two half registers lie in one full one.
        if (said["full"], said["half"]) not in ((full, half), (max(full, -(-half // 2)), 0)):
            raise ListingError(
                f"{self.stage} {self.program}: {full} full and {half} half registers were found,"
                f" {said['full']} and {said['half']} were used"
            )


def registers_of(instruction, aliases=()):
    """What of the registers an instruction names, as Shader.inputs."""
    operands = instruction.text[len(instruction.name) :].strip()
    if instruction.category == CATEGORIES.index("texture"):
        # The mask says how many are written; what is read has been written before.
        written = re.match(r"(?:\([fus]\d+\))?\(([xyzw]+)\)(h?)r(\d+)\.([xyzw])", operands)
        if written:
            yield bool(written[2]), int(written[3]), "xyzw".index(written[4]), "xyzw".index(written[1][-1]) + 1
        return
    for found in _REGISTER.finditer(operands):
        if found[0].removeprefix("(r)") in aliases:
            continue
        # The target moves on with each repetition, a source only if it is marked.
        moves = found.start() == 0 or found[1]
        yield bool(found[2]), int(found[3]), "xyzw".index(found[4]), 1 + (instruction.repeat if moves else 0)


def parse_instruction(line):
    """An instruction of a listing's line without Mesa's prefix; None if it is none."""
    flags = _FLAGS.match(line).group()
    text = line[len(flags) :].strip()
    name = text.split(maxsplit=1)[0] if text else ""
    category = CATEGORY_OF.get(name.split(".")[0])
    if category is None:
        return None

    def flag(kind):
        found = re.search(rf"\({kind}(\d+)\)", flags)
        return int(found[1]) if found else 0

    target = re.search(r"#(l\d+)", text)
    return Instruction(name, category, flag("rpt"), flag("nop"), text, target[1] if target else "")


def find_loops(instructions, labels):
    """Natural loops: from a label to the last jump back to it; inner ones too."""
    ends = {}
    for i, instruction in enumerate(instructions):
        start = labels.get(instruction.target)
        if start is not None and start <= i:
            ends[start] = max(ends.get(start, i), i)
    return [Loop(first, last, trips_of(instructions, first, last)) for first, last in sorted(ends.items())]


def trips_of(instructions, first, last):
    """How often a loop runs that counts a register in constant steps from a constant up to a constant:

        mov.u32u32 rN, FROM … label: … cmps.s.ge p0.x, rN, LIMIT … add.u rN, rN, STEP … br p0.x, OUT … jump label

    Everything else is None: limits from uniforms and memory, and comparisons that have been rewritten."""
    body = instructions[first : last + 1]
    for i, instruction in enumerate(body):
        compared = re.match(rf"cmps\.[su]\.(ge|gt) \S+, {_COUNTER}, {_CONSTANT}$", instruction.text)
        if not compared:
            continue
        counter, limit = compared[2], _value(compared[3])
        steps = [(k, step) for k, step in ((k, _step(x, counter)) for k, x in enumerate(body)) if step]
        start = _start(instructions[:first], counter)
        if len(steps) != 1 or start is None:
            continue
        (place, step), reach = steps[0], limit - start + (compared[1] == "gt")
        passes = max(0, -(-reach // step))
        # Compared after the step, the body has run once before.
        return max(passes, 1) if place < i else passes
    return None


_COUNTER = r"(h?r\d+\.\w)"
_CONSTANT = r"(\d+|h\(\d+\))"


def _value(constant):
    return int(constant.strip("h()"))


def _step(instruction, counter):
    """What an instruction adds to the counter; None if it does something else."""
    found = re.match(rf"add\.[su] {re.escape(counter)}, {re.escape(counter)}, {_CONSTANT}$", instruction.text)
    return _value(found[1]) if found else None


def _start(before, counter):
    """The constant that the counter was last set to; None if it was set to something else."""
    for instruction in reversed(before):
        found = re.match(rf"mov\.\S+ {re.escape(counter)}, (\S+)$", instruction.text)
        if found:
            return int(found[1]) if found[1].isdecimal() else None
        if re.match(rf"\S+ {re.escape(counter)}(,|$)", instruction.text):
            return None
    return None


def read_statistics(lines):
    """The compiler's own figures from the comments behind the instructions."""
    text = "\n".join(lines)

    def number(pattern, optional=False):
        found = re.search(pattern, text)
        if not found:
            if optional:
                return 0
            raise ListingError(f"the statistics have no '{pattern}'")
        return int(found[1])

    return {
        "instructions": number(r"(\d+) instr,"),
        "nops": number(r"(\d+) nops,"),
        "half": number(r"(\d+) half,"),
        "full": number(r"(\d+) full,"),
        "categories": [number(rf"(\d+) cat{i}\b") for i in range(8)],
        "ss_stall": number(r"(\d+) sstall"),
        "sy_stall": number(r"(\d+) systall"),
        "loops": number(r"(\d+) loops"),
        "waves": number(r"(\d+) max_waves"),
        "double_threads": number(r"(\d+) double_threadsize", optional=True),
        "preamble": number(r"(\d+) preamble-instr", optional=True),
    }


def parse_listing(lines):
    """A Shader from the lines between the header and the statistics' end, both included, without Mesa's prefix."""
    end = next((m for m in map(_END.match, lines) if m), None)
    if not end:
        raise ListingError("the listing has no end")
    instructions, labels, inputs, prefetches = [], {}, [], 0
    for line in lines:
        line = line.strip()
        given = _INPUT.match(line)
        if given:
            inputs.append((bool(given[1]), int(given[2]), "xyzw".index(given[3]), int(given[4], 16).bit_length()))
        prefetches += line.startswith("@tex(")
        if not line or line[0] in "@;":
            continue
        label = _LABEL.match(line)
        if label:
            labels[label[1]] = len(instructions)
            continue
        instruction = parse_instruction(line)
        # Behind the end there is padding.
        if instruction and not (instructions and instructions[-1].name == "end"):
            instructions.append(instruction)
    return Shader(end[1], int(end[2]), int(end[3]), instructions, labels, inputs, prefetches, read_statistics(lines))


def shaders_of(log):
    """The listings of a log, an iterable of lines, as lists of lines without prefix. What other programs write
    between lines is left out."""
    listing = None
    for line in log:
        if not line.startswith(_PREFIX):
            continue
        line = line[len(_PREFIX) :].rstrip("\n")
        if _HEADER.match(line):
            listing = []
        if listing is None:
            continue
        listing.append(line)
        if line.startswith("; pos (") or (listing and line == "" and any(_END.match(x) for x in listing[-8:])):
            yield listing
            listing = None
