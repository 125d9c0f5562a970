"""Elastic bearings: published pressures and deflections.

Freund 1995: a journal over a thin steel diaphragm; COMSOL 6.4: a journal under 40 kN from high to low speed. What
the publications leave open is taken from the tests of MBDyn's bearing module (mboct-mbdyn-pkg,
mbdyn_post_ehd_load_output 10 and 14), from which the digitised figures come too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Body,
    BodyMesh,
    Cell,
    Cylinder,
    Elastic,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Fluid,
    Held,
    Side,
    Supports,
    at_points,
    body_wall,
    film,
    film_space,
    hollow_cylinder,
    loads,
    rectangle,
)

FREUND_DEFLECTION = {10: 122, 20: 65, 30: 28, 40: 18, 50: 20, 60: 30, 70: 40, 80: 48, 90: 50, 100: 60, 110: 45,
                     120: 30, 130: 0}  # fmt: skip
FREUND_PRESSURE = dict(zip(
    range(0, 210, 10),
    (0, 100, 200, 300, 375, 425, 525, 650, 750, 875, 975, 1100, 1175, 1175, 1050, 925, 700, 450, 200, 50, 0),
    strict=True,
))  # fmt: skip
BORE, HALF_WIDTH, SHEET, SLOT = 0.1, 0.1, 1e-3, 1e-3
SPAN, WIDE_END, NARROW_END = np.radians(132.0), 64e-3, 7.5e-3


def _diaphragm(along: int, beside: int, across: int, outside: int) -> BodyMesh:
    """Half of the bore's innermost millimetre, `backed` by the shell but for the diaphragm.

    The diaphragm narrows from 128 mm at the slot (0 deg, a free edge) to 15 mm at 132 deg. The shell behind
    (49 mm of steel, held outside) deforms by less than a micrometre and is taken as rigid.
    """
    around, tall = along + beside, across + outside
    mesh = hollow_cylinder((BORE, BORE + SHEET), 1.0, (1, around, tall), angles=(0.1, 1.1)).mesh
    x, y, z = mesh.doflocs
    start = 0.5 * SLOT / BORE
    lines = np.r_[np.linspace(start, start + SPAN, along + 1), np.linspace(start + SPAN, 2 * np.pi - start, beside + 1)]
    angle = np.interp((np.arctan2(y, x) - 0.1) * around, np.arange(around + 1), np.delete(lines, along))
    half = _half_width(angle - start)
    step = z * tall
    height = np.where(step <= across, step / across * half, half + (step - across) / outside * (HALF_WIDTH - half))
    radius = np.hypot(x, y)
    mesh = replace(mesh, doflocs=np.vstack([radius * np.cos(angle), radius * np.sin(angle), height]))
    corners = mesh.p[:, mesh.facets]
    middle = corners.mean(axis=1)
    back = (np.abs(np.hypot(*corners[:2]) - BORE - SHEET) < 1e-9).all(axis=0)
    turned = np.arctan2(middle[1], middle[0]) % (2.0 * np.pi) - start
    backed = back & ((turned > SPAN) | (middle[2] > _half_width(turned)))
    return BodyMesh(replace(mesh, _boundaries={**mesh.boundaries, "backed": np.flatnonzero(backed)}))


def _half_width(turned: np.ndarray) -> np.ndarray:
    return WIDE_END + (NARROW_END - WIDE_END) * np.clip(turned / SPAN, 0.0, 1.0)


def _freund(folder, fine: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle (deg), pressure (kPa) and deflection (um) of the middle plane.

    Radial clearance 150 um, eccentricity 0.3 towards 180 deg, shaft 28 m/s, 9.29 mPa s, zero pressure at the slot
    and the sides, cavitation at zero. Left out: the oil's compressibility (1.2 MPa beside 2.4 GPa).
    """
    sheet = _diaphragm(10 * fine, 3 * fine, 3 * fine, fine)
    steel, held = Elastic(200e9, 0.3), Supports(clamped=("backed", "top"), symmetry=("bottom",))
    size = (2.0 * np.pi * BORE - SLOT, HALF_WIDTH)
    mesh = rectangle(size, (45 * fine, 7 * fine), origin=(0.5 * SLOT, 0.0), cell=Cell.QUADRILATERAL)
    space = film_space(mesh)
    walls = body_wall(Body(sheet, steel, held, "inner", Cylinder(BORE, Side.BORE)), space, folder=folder)
    thickness = space.sample(lambda x, y: 150e-6 * (1.0 + 0.3 * np.cos(x / BORE)))
    posed = film(thickness, 0.00929, velocity_moving=(np.full((1, 1), 28.0), ZERO))
    ends = dict.fromkeys(("left", "right", "top"), Held(0.0))
    found = FilmSolver(space).solve(FilmProblem(space, posed, ends, walls=walls))
    assert loads(found).mass_balance_error < 1e-9
    return _middle_plane(space, found.pressure[space.vertex_dofs] * 1e-3, found.deformation * 1e6)


def _middle_plane(space: FilmSpace, *fields: np.ndarray) -> tuple[np.ndarray, ...]:
    on = np.flatnonzero(np.abs(space.vertices[:, 1]) < 1e-9)
    on = on[np.argsort(space.vertices[on, 0])]
    return (np.degrees(space.vertices[on, 0] / BORE), *(field[on] for field in fields))


def _tolerance(table: dict[int, int], at: int, largest: float) -> float:
    """3 % of the largest value, for reading off and the source's own mesh, and one degree of the curve's slope."""
    places = list(table)
    return 0.03 * largest + float(
        np.abs(np.gradient(np.array(list(table.values()), dtype=float), places))[places.index(at)]
    )


@pytest.mark.slow
def test_freund_diaphragm(tmp_path, validation):
    """Table of a printed figure, steps of 25 kPa and 5 um. MBDyn's own test of it allows 15 % of the largest
    pressure and 7 % of the largest deflection at each point, and 5 % and 4 % in the mean."""
    angle, pressure, deflection = _freund(tmp_path, 2)
    rupture = (
        "the film of the thesis ruptures some 15 deg before this one, which up to 160 deg agrees with it. The "
        "table does not say by what condition: JFO and Reynolds' give 345 kPa at 180 deg, no rupture 46 kPa"
    )
    for what, unit, table, field, largest, mean in (
        ("pressure", "kPa", FREUND_PRESSURE, pressure, 1175.0, 5.0),
        ("deflection", "um", FREUND_DEFLECTION, deflection, 195.0, 4.0),
    ):
        here = {at: float(np.interp(at, angle, field)) for at in table}
        for at in table:
            validation(
                case="Journal over a diaphragm",
                source="Freund 1995, digitised",
                quantity=f"{what} in the middle plane at {at} deg",
                unit=unit,
                expected=table[at],
                obtained=here[at],
                tolerance=_tolerance(table, at, largest),
                note=f"tolerance: 3 % of the largest, {largest:g} {unit}, and one degree of the curve",
                missed=rupture if what == "pressure" and at >= 170 else "",
            )
        validation(
            case="Journal over a diaphragm",
            source="Freund 1995, digitised",
            quantity=f"{what}, mean difference of all points/largest",
            unit="%",
            expected=0.0,
            obtained=100.0 * float(np.mean([abs(here[at] - table[at]) for at in table])) / largest,
            tolerance=mean,
            note="tolerance: that of MBDyn's own test",
        )


@pytest.mark.long
def test_freund_diaphragm_converges(tmp_path):
    """The agreement is no accident of the mesh: a finer one changes less than the reading does."""
    coarse, fine = (_freund(tmp_path, n) for n in (2, 3))
    at = np.arange(5.0, 200.0, 5.0)
    for field, largest in ((1, 1175.0), (2, 195.0)):
        difference = np.interp(at, coarse[0], coarse[field]) - np.interp(at, fine[0], fine[field])
        assert np.abs(difference).max() < 0.03 * largest


LOAD, CLEARANCE, JOURNAL_HALF_WIDTH, GROOVE = 40e3, 200e-6, 33.5e-3, 10e-3
COMSOL = {
    10000.0: {330: 0, 320: 18, 300: 67, 287.6: 79, 280: 78, 260: 60, 240: 40, 220: 24, 200: 10, 188: 2},
    316.0: {289: 0, 280: 214, 271: 150, 260: 60, 240: 16, 220: 6, 200: 4},
    100.0: {282: 0, 280: 200, 271: 200, 260: 48, 240: 9, 220: 4, 200: 2},
}

COMSOL_MISSED = {(316.0, 289), (316.0, 280), (100.0, 282), (100.0, 280), (100.0, 260)}


def _thickened(pressure, viscosity):
    thicker = viscosity * np.exp(25e-9 * pressure)
    return thicker, 25e-9 * thicker


def _pressed(pressure):
    return 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure), 0.6e-9 / (1.0 + 1.7e-9 * pressure) ** 2


@dataclass
class Journal:
    """A shaft in its bearing, turning towards larger angles, the load towards 270 deg."""

    space: FilmSpace
    solver: FilmSolver
    problem: FilmProblem
    last: FilmSolution | None = None

    def solve(self, place: np.ndarray) -> FilmSolution:
        """With the shaft's axis at `place` (x, y) in radial clearances."""
        angle = self.space.points[0] / BORE
        thickness = CLEARANCE * (1.0 - place[0] * np.cos(angle) - place[1] * np.sin(angle))
        posed = replace(self.problem.film, thickness=thickness)
        self.last = self.solver.solve(replace(self.problem, film=posed), self.last)
        return self.last

    def unbalance(self, place: np.ndarray) -> np.ndarray:
        pressure = at_points(self.space, self.solve(place).pressure) * self.space.area * 2.0
        angle = self.space.points[0] / BORE
        return -np.array([np.sum(pressure * np.cos(angle)), np.sum(pressure * np.sin(angle)) + LOAD]) / LOAD

    def settle(self, place: np.ndarray) -> np.ndarray:
        for _ in range(60):
            rest = self.unbalance(place)
            if np.abs(rest).max() < 1e-6:
                return place
            slope = np.column_stack([(self.unbalance(place + d) - rest) / 1e-6 for d in 1e-6 * np.eye(2)])
            step = -np.linalg.solve(slope, rest)
            while 1.0 - np.hypot(*(place + step)) < 0.7 * (1.0 - np.hypot(*place)):
                step *= 0.5
            place = place + step
        raise AssertionError(f"shaft not in balance: {rest}")


def _journal(along: int, across: int) -> Journal:
    """Half of it; grooves of 0.2 MPa over the whole width at 0 and 180 deg; cells finer from 255 to 300 deg."""
    groove = np.degrees(0.5 * GROOVE / BORE)
    marks = np.array([0.0, groove, 180.0 - groove, 180.0 + groove, 255.0, 300.0, 360.0 - groove, 360.0])
    counts = along * np.array([1, 6, 2, 8, 16, 6, 1])
    parts = [np.linspace(*ends, n, endpoint=False) for *ends, n in zip(marks[:-1], marks[1:], counts, strict=True)]
    lines = np.concatenate(parts)
    size = (2.0 * np.pi * BORE, JOURNAL_HALF_WIDTH)
    mesh = rectangle(size, (len(lines), across), cell=Cell.QUADRILATERAL, periodic_x=True)
    space = film_space(mesh)
    x, y = space.vertices.T
    x = BORE * np.radians(np.interp(x / size[0] * len(lines), np.arange(len(lines) + 1), np.r_[lines, 360.0]))
    space = space.moved(np.column_stack([x, y]))
    within = np.abs((np.degrees(x / BORE) + 90.0) % 180.0 - 90.0) <= groove + 1e-6
    held = np.full(space.size, np.nan)
    held[space.vertex_dofs[within]] = 2e5
    oil = Fluid(_thickened, _pressed)
    problem = FilmProblem(space, film(CLEARANCE, 0.075), {"top": Held(0.0)}, held_nodes=held, fluid=oil)
    return Journal(space, FilmSolver(space), problem)


@pytest.mark.slow
def test_comsol_journal(validation):
    """Rigid walls, as MBDyn's own comparison has them (no body is given); viscosity and density by pressure.

    Read off a figure to 2 bar and 1 degree: 6 % of the peak. The published curves are weighed too: joined by
    straight lines they must carry what this film carries, its profile across the width being theirs.
    """
    place = np.array([0.25, -0.5])
    case = _journal(3, 8)
    for rpm in (10000.0, 3162.0, 1000.0, 316.0, 178.0, 100.0):
        velocity = (np.full((1, 1), rpm * np.pi / 30.0 * BORE), ZERO)
        case.problem = replace(case.problem, film=replace(case.problem.film, velocity_moving=velocity))
        place = case.settle(place)
        found = case.solve(place)
        assert loads(found).mass_balance_error < 1e-8
        angle, pressure = _middle_plane(case.space, found.pressure[case.space.vertex_dofs] * 1e-5)
        if rpm not in COMSOL:
            continue
        table = COMSOL[rpm]
        at, read = np.array(list(table)), np.array(list(table.values()), dtype=float)
        weight = np.cos(np.radians(angle - 270.0))
        published = np.interp(angle, at[::-1], read[::-1], left=0.0, right=0.0)
        short = 1.0 - float(np.trapezoid(published * weight, angle) / np.trapezoid(pressure * weight, angle))
        assert (short < 0.03) == (rpm == 10000.0)
        for where, expected in table.items():
            reason = (
                f"the published points, joined, carry {short:.0%} less than 40 kN (at 10000 rpm 2 %), their film "
                "ends 8 deg earlier; springs of 1e12 to 1e13 Pa/m behind the bore only flatten this film"
            )
            validation(
                case="Journal under 40 kN, viscosity and density by pressure",
                source="COMSOL 6.4, digitised",
                quantity=f"pressure in the middle plane at {where:g} deg, {rpm:g} rpm",
                unit="bar",
                expected=expected,
                obtained=float(np.interp(where, angle, pressure)),
                tolerance=0.06 * read.max(),
                note="rigid walls; tolerance: 6 % of the peak",
                missed=reason if (rpm, where) in COMSOL_MISSED else "",
            )
