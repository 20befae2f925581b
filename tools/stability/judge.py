"""Judges the native cases: what lobelight_stability printed against 50 digits and against independent quadrature."""

from judge_fits import judge_data, judge_slice, judge_step
from judge_points import judge_brdf, judge_gaussian
from judge_tables import judge_table
from verdict import Verdict

JUDGES = {
    "gaussian": judge_gaussian,
    "brdf": judge_brdf,
    "step": judge_step,
    "slice": judge_slice,
    "data": judge_data,
    "table": judge_table,
}


def judge(group, record):
    """The verdicts of one record."""
    if "exception" in record and group != "data":
        verdict = Verdict(record, group)
        verdict.require(False, f"threw: {record['exception']}")
        return [verdict.done()]
    result = JUDGES[group](record)
    return result if isinstance(result, list) else [result]
