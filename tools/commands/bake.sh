#!/usr/bin/env bash
# fits a BRDF by lobes in the C++ library and saves the table (--brdf --alpha AX,AY --lobes N --out X.res)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev bake --brdf ward|ward_bounded|ggx --alpha AX,AY --lobes N --out X.res [OPTIONS]
       ./dev bake --brdf FILE.binary|FILE_rgb.bsdf --lobes N --out X.res [OPTIONS]

--brdf FILE          measurements, MERL's or RGL's; --alpha is then estimated, unless it is given
--lobes auto         the fewest lobes (1, 2, 3, 4, 6, 8, 12, 16, 24 or 32) whose table has --target DB (default 30)
                     on every one of four environments, the lobes' light taken exactly, without the pyramid
--recipe FILE.json   brdf, alpha, lobes, views, method, refine, placement, reach, seed and threads; options go before it
--views T,P          elevations and azimuths of the view (default 16,1 isotropic, 16,8 anisotropic)
--method M           continuation (default) or independent
--placement auto|em|arc  lobes where the likelihood wants them, or along the highlight; auto (default) is the better one
--reach R            how far lobes along the highlight reach, in slopes over alpha (default 0: the best)
--refine yes|no      fit the lobes to what the pyramid draws after they are fitted as Gaussians (default no)
--seed N, --threads N
--out X.res|X.tres   the table, a LobeTable resource
--export X.json      the lobes themselves
--json FILE          time, memory, iterations and log-likelihoods
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi

need_engine
need_library
need_import
export LOBELIGHT_CWD=$PWD LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi
godot_headless --no-header --script res://bake/bake.gd -- "$@"
