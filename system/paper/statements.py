"""Statements of the paper's text on its figures, one by one."""

from collections.abc import Mapping
from math import inf

from system.paper.figure import Figure, Unit
from system.paper.judge import OURS, PaperClaim, Range, number_claim, share_claim
from system.paper.pair_statements import MOTION_CLAIMS, PAIR_CLAIMS

_TABLE = (
    ("displacement", "the pump with the displacement of 90 mL/r", Unit.DISPLACEMENT, 89.5e-6, 90.5e-6),
    ("pressure", "the rated pressure of the test pump is 35 MPa", Unit.PRESSURE, 34.5e6, 35.5e6),
    ("speed", "the rated speed is 2100 r/min", Unit.SPEED, 2099.5 / Unit.SPEED.factor, 2100.5 / Unit.SPEED.factor),
    ("swash_angle", "at swash plate angle of 16.2°", Unit.ANGLE, 16.15 / Unit.ANGLE.factor, 16.25 / Unit.ANGLE.factor),
    ("spring", "not too big (1080 N in the test pump)", Unit.FORCE, 1079.5, 1080.5),
    (
        "piston_film",
        "mean depth of oil film in the clearance between piston and cylinder is approximately 15 μm",
        Unit.FILM,
        14.5e-6,
        15.5e-6,
    ),
    ("plate_film", "valve plate cylinder interface, approximately mean depth of 8 μm", Unit.FILM, 7.5e-6, 8.5e-6),
    (
        "piston_cylinder",
        "initial friction coefficients of piston cylinder pairs were set to 0.03",
        Unit.NUMBER,
        0.025,
        0.035,
    ),
    ("slipper_swash_plate", "slipper swash plate pairs .. set to 0.008", Unit.NUMBER, 0.0075, 0.0085),
    ("valve_plate_cylinder", "valve plate cylinder pairs .. set to .. 0.01", Unit.NUMBER, 0.005, 0.015),
    (
        "piston_slipper_socket",
        "coefficients in piston head slipper socket pairs were set to 0.02",
        Unit.NUMBER,
        0.015,
        0.025,
    ),
    (
        "ball_guide_retainer",
        "friction coefficients of ball guide retainer pairs were set to 0.12",
        Unit.NUMBER,
        0.115,
        0.125,
    ),
    ("bearings", "initial friction coefficients of bearings .. are set to 0.001", Unit.NUMBER, 0.0005, 0.0015),
)
_TABLE_CLAIMS = tuple(
    PaperClaim(f"table1.{name}", Figure.TABLE1, words, name.replace("_", " "), unit, Range(low, high))
    for name, words, unit, low, high in _TABLE
)
_EFFICIENCY_CLAIMS = (
    share_claim(
        "fig2.best",
        Figure.FIG2,
        "the maximum overall efficiency of the test pump at the speed of 2100 r/min can reach 90%",
        "best overall efficiency, Eq. (3)",
        0.895,
        0.905,
    ),
    share_claim(
        "fig2.falls",
        Figure.FIG2,
        "with the decrease of displacement or pressure, the overall efficiency decreases considerably",
        "efficiency at the least displacement, and at the least pressure, of the best",
        0.0,
        0.9,
        f"considerably: by a tenth or more, {OURS}",
    ),
    share_claim(
        "fig3.volumetric",
        Figure.FIG3,
        "the volumetric efficiency is generally higher than the mechanical efficiency",
        "volumetric less mechanical efficiency, Eqs. (4), (5)",
        0.0,
        inf,
    ),
    number_claim(
        "fig3.greater",
        Figure.FIG3,
        "the hydro-mechanical losses of pump are generally greater than the volumetric losses",
        "hydro-mechanical over volumetric loss, Eqs. (2), (1)",
        1.0,
        inf,
    ),
    share_claim(
        "fig3.case1",
        Figure.FIG3,
        "[at 5 MPa] a great proportion ranging from 87% to 89%",
        "hydro-mechanical share of the losses, 13 to 100 % of displacement",
        0.865,
        0.895,
    ),
    share_claim(
        "fig3.case2",
        Figure.FIG3,
        "[at 13 % of full displacement] from 68% to 97% of the total power losses",
        "hydro-mechanical share of the losses, near 0 to 35 MPa",
        0.675,
        0.975,
    ),
)
_FILM_CLAIMS = (
    PaperClaim(
        "fig8.mean",
        Figure.FIG8,
        "The mean depth of oil film .. is approximately 15 μm, mainly determined by the fit tolerance",
        "mean film over area and turn",
        Unit.FILM,
        Range(14.5e-6, 15.5e-6),
    ),
    number_claim(
        "fig8.nonuniform",
        Figure.FIG8,
        "generally presents a nonuniform depth field",
        "mean over least film of the field",
        1.1,
        inf,
        f"nonuniform: by a tenth or more, {OURS}",
    ),
    number_claim(
        "fig9.falls",
        Figure.FIG9,
        "With the increase of the displacement, the oil film depth of slipper swash plate pair gradually decreases",
        "mean film at a displacement over that at the next lower",
        0.0,
        1.0,
    ),
    number_claim(
        "fig9.faster",
        Figure.FIG9,
        "change rate of oil film depth between slipper swash plate interface and "
        "piston cylinder interface [the slipper's the larger]",
        "relative change of the slipper's mean film over that of the piston's",
        1.0,
        inf,
    ),
)
_CHAMBER_CLAIMS = (
    number_claim(
        "fig10.sections",
        Figure.FIG10,
        "a piecewise function divided into eight sections",
        "sections of both ports over a turn",
        8.0,
        8.0,
    ),
    share_claim(
        "fig10.groove",
        Figure.FIG10,
        "one of the key factors affecting the pressure of oil in piston chamber, "
        "especially in the transition region where the .. area of relief groove changes fast",
        "part of the rise from inlet to delivery pressure made while the groove alone is open",
        0.5,
        inf,
        f"key factor: half of the rise or more, {OURS}",
    ),
    share_claim(
        "fig11.none",
        Figure.FIG11,
        "No pressure impact is observed in the pre-relieving pressure transition region at the pressure of 35 MPa",
        "peak above the delivery pressure, of the rated pressure",
        -inf,
        0.01,
        f"no impact: within 1 % of the rated pressure, not visible in the print, {OURS}",
    ),
    share_claim(
        "fig11.small",
        Figure.FIG11,
        "a small pressure impact is produced in the pre-relieving pressure transition region at the pressure of 5 MPa",
        "peak above the delivery pressure, of the rated pressure",
        0.01,
        0.1,
        f"small: 1 to 10 % of the rated pressure, {OURS}",
    ),
)
_FIT_CLAIMS = (
    number_claim(
        "fig13.solved",
        Figure.FIG13,
        "The 7 undetermined coefficients in Eq. (21) are solved under 7 pressure "
        "differences .. at certain fixed speed and displacement conditions",
        "combinations of coefficients that the seven points determine",
        7.0,
        7.0,
    ),
    number_claim(
        "fig13.range",
        Figure.FIG13,
        "The tuned friction coefficients in Fig. 13 are all within a reasonable range",
        "furthest coefficient over the end of its range (1: within)",
        1.0,
        1.0,
    ),
    share_claim(
        "fig16.linear",
        Figure.FIG16,
        "the simulation results present a linear variation trend on the whole versus the pressure difference",
        "largest departure of the pairs' sum from a straight line",
        0.0,
        0.05,
        f"on the whole: within 5 %, {OURS}",
    ),
    share_claim(
        "fig16.agrees",
        Figure.FIG16,
        "the simulation results agree well with the experimental results in a wide operating range",
        "Eq. (2) of the simulated bench over the pairs' sum, less 1",
        -0.1,
        0.1,
        f"well: within 10 %, {OURS}; no text gives the test points",
    ),
)
CLAIMS: Mapping[str, PaperClaim] = {
    claim.id: claim
    for claim in (
        *_TABLE_CLAIMS,
        *_EFFICIENCY_CLAIMS,
        *_FILM_CLAIMS,
        *_CHAMBER_CLAIMS,
        *_FIT_CLAIMS,
        *PAIR_CLAIMS,
        *MOTION_CLAIMS,
    )
}
"""All statements by id."""
