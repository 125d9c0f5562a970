"""Statements of the paper's text on its friction pairs and their motion; the others are in `statements`."""

from math import inf

from system.paper.figure import Figure
from system.paper.judge import OURS, number_claim, share_claim

_FULL = "at full displacement, four speeds, 5 to 35 MPa"
PAIR_CLAIMS = (
    share_claim(
        "fig17.piston_cylinder",
        Figure.FIG17,
        "occupied proportion respectively vary in the range of 21.35%−58.96% [piston cylinder pair]",
        f"share {_FULL}",
        0.21345,
        0.58965,
    ),
    share_claim(
        "fig17.slipper_swash_plate",
        Figure.FIG17,
        "28.97%−53.25% [slipper swash plate pair]",
        f"share {_FULL}",
        0.28965,
        0.53255,
    ),
    share_claim(
        "fig17.valve_plate_cylinder",
        Figure.FIG17,
        "5.97%−23.25% [valve plate cylinder pair]",
        f"share {_FULL}",
        0.05965,
        0.23255,
    ),
    share_claim(
        "fig17.top",
        Figure.FIG17,
        "The uppermost source of hydro-mechanical losses of pump at full displacement "
        "generally is either piston cylinder pair or slipper swash plate pair",
        f"points where it is, {_FULL}",
        1.0,
        1.0,
    ),
    share_claim(
        "fig17.main",
        Figure.FIG17,
        "the main sources of the hydro-mechanical losses in the pump hold changeless "
        "with the variation of pressure levels",
        "points where the three uppermost are these three pairs",
        1.0,
        1.0,
    ),
    share_claim(
        "fig17.ball_guide",
        Figure.FIG17,
        "a proportion of up to nearly 10% .. under the conditions of 14% of the rated pressure [2100 r/min]",
        "share of the ball guide-retainer pair",
        0.09,
        0.1,
        f"nearly 10 %: 9 to 10 %, {OURS}",
    ),
    share_claim(
        "fig18.independent",
        Figure.FIG18,
        "the hydro-mechanical losses in ball guide retainer pair are almost independent of the pressure levels",
        "largest change of its loss over pressure",
        0.0,
        0.05,
        f"almost: within 5 %, {OURS}",
    ),
    number_claim(
        "fig18.proportional",
        Figure.FIG18,
        "losses in other friction pairs which are proportional to the pressure levels",
        "loss at 35 MPa over that at 5 MPa, the six other pairs",
        6.5,
        7.5,
    ),
    share_claim(
        "fig19.agrees",
        Figure.FIG19,
        "comparisons of hydro-mechanical losses generated in the ball guide retainer pair [deviations stated for "
        "2100 r/min alone]",
        "multibody over equation, less 1, below rated speed",
        -0.05,
        0.05,
        f"close: within 5 %, {OURS}",
    ),
    number_claim(
        "fig19.rated",
        Figure.FIG19,
        "relatively significant deviations can be found in the case of 2100 r/min",
        "deviation at rated speed over that at the others",
        1.2,
        inf,
        f"significant: a fifth more, {OURS}",
    ),
    number_claim(
        "fig20.piston",
        Figure.FIG20,
        "the proportion occupied by .. the piston cylinder pairs greatly decreases with the decrease of displacement",
        "share at a displacement over that at the next higher",
        0.0,
        1.0,
    ),
    number_claim(
        "fig20.others",
        Figure.FIG20,
        "the proportion occupied by .. the slipper swash plate pairs and valve "
        "plate cylinder pairs gradually increases",
        "shares at a displacement over those at the next higher",
        1.0,
        inf,
    ),
    share_claim(
        "fig21.lead",
        Figure.FIG21,
        "the main sources .. change to slipper swash plate pair and valve plate "
        "cylinder pair at low displacement conditions",
        "pressures where these two are uppermost",
        1.0,
        1.0,
    ),
    share_claim(
        "fig22.lead",
        Figure.FIG22,
        "the main sources .. change to slipper swash plate pair and valve plate "
        "cylinder pair at low displacement conditions",
        "speeds where these two are uppermost",
        1.0,
        1.0,
    ),
)
MOTION_CLAIMS = (
    share_claim(
        "fig15.agrees",
        Figure.FIG15,
        "the agreement between the dynamic simulation result and the equation result is very good",
        "largest distance between both loci, of the locus' length",
        0.0,
        0.01,
        f"very good: within 1 %, {OURS}",
    ),
    number_claim(
        "equations.8",
        Figure.EQUATIONS,
        "Eq. (8): a_p = .. (tan²β tan²γ (1 + sin²φ) + cos φ) ..",
        "printed acceleration over the derivative of Eq. (7), at the dead centres",
        0.999,
        1.001,
    ),
    number_claim(
        "equations.9",
        Figure.EQUATIONS,
        "Eq. (9): v_s = R cos(γ + β) ..",
        "printed sliding speed over that of the ball centre on the plate",
        0.999,
        1.001,
    ),
    number_claim(
        "equations.12",
        Figure.EQUATIONS,
        "Eq. (12): k = ..",
        "printed turning of the retainer over that of a rigid body",
        0.999,
        1.001,
    ),
    number_claim(
        "equations.14",
        Figure.EQUATIONS,
        "Eq. (14): dp_c/dt = K_e/V_c (q_r − q_i − .. − dV_c/dt)",
        "displacement that the print leaves over the true one",
        0.999,
        1.001,
    ),
    number_claim(
        "equations.15",
        Figure.EQUATIONS,
        "Eq. (15): q_lp = .. − π d_p δ_p v_p/2",
        "printed flow dragged out of the chamber over the true one",
        0.999,
        1.001,
    ),
)
