"""Stokes and Navier-Stokes reference."""

from __future__ import annotations

import numpy as np
import pytest
import skfem

from reynolds import FilmInputError, FilmNotConverged
from reynolds.stokes.flow import FlowProblem, held, solve_navier_stokes, solve_stokes, straight, together
from reynolds.stokes.meshes import channel_mesh, graded, step_mesh
from reynolds.stokes.results import flux, mean_pressure, turning_places, wall_shear
from reynolds.stokes.space import Symmetry, body_force, taylor_hood


def errors(flow, velocity, pressure):
    """L2 errors of a flow's velocity and of its pressure less their means."""
    space = flow.problem.space
    fine = skfem.Basis(space.mesh, space.velocity.elem, intorder=8)
    u = fine.interpolate(flow.velocity)
    p = fine.with_element(space.pressure.elem).interpolate(flow.pressure)
    x, dx = fine.global_coordinates(), fine.dx
    off = np.asarray(p) - pressure(x)
    off = off - (off * dx).sum() / dx.sum()
    return float(np.sqrt((((np.asarray(u) - velocity(x)) ** 2).sum(0) * dx).sum())), float(np.sqrt((off**2 * dx).sum()))


def enclosed(mesh, viscosity, velocity, force=None):
    space = taylor_hood(mesh)
    held_all = together(held(space, name, velocity) for name in mesh.boundaries)
    return FlowProblem(space, viscosity, held_all, None if force is None else body_force(space, force), enclosed=True)


def triangles(n):
    mesh = skfem.MeshTri.init_tensor(*(np.linspace(0.0, 1.0, n + 1),) * 2)
    return mesh.with_boundaries({"wall": mesh.boundary_facets()})


@pytest.mark.parametrize(("symmetry", "resistance"), [(Symmetry.PLANE, 12.0), (Symmetry.AXIAL, 8.0)])
def test_poiseuille_flow_is_held_exactly(symmetry, resistance):
    even = symmetry is Symmetry.AXIAL
    mesh = channel_mesh(2.0, 1.0, 5, 3, even=even)
    space = taylor_hood(mesh, symmetry)

    def parabola(x):
        return np.stack([2.0 * (1.0 - x[1] ** 2) if even else 6.0 * x[1] * (1.0 - x[1]), 0.0 * x[1]])

    ends = [held(space, "wall"), held(space, "inlet", parabola), straight(space, "outlet")]
    flow = solve_stokes(FlowProblem(space, 3.0, together(ends + ([straight(space, "axis")] if even else []))))
    assert mean_pressure(flow, "inlet") == pytest.approx(3.0 * resistance * 2.0, rel=1e-12)
    assert flux(flow, "outlet") == pytest.approx(np.pi if even else 1.0, rel=1e-12)
    assert flow.velocity == pytest.approx(space.velocity.project(parabola), abs=1e-11)
    if not even:
        assert wall_shear(flow, 0.0)[1] == pytest.approx(18.0, rel=1e-11)


def test_inertia_leaves_developed_flow_alone():
    space = taylor_hood(channel_mesh(3.0, 1.0, 6, 3))
    ends = [held(space, "wall"), held(space, "inlet", lambda x: np.stack([6 * x[1] * (1 - x[1]), 0 * x[1]]))]
    problem = FlowProblem(space, 1.0, together([*ends, straight(space, "outlet")]))
    (flow,) = solve_navier_stokes(problem, [200.0])
    assert mean_pressure(flow, "inlet") == pytest.approx(36.0, rel=1e-10)


def test_annular_flow(refine, validation):
    inner, outer = 1.0, 3.0
    ring = np.log(outer / inner)

    def drop(n):
        x, r = np.linspace(0.0, 1.0, 3), np.linspace(inner, outer, n + 1)
        mesh = skfem.MeshQuad.init_tensor(x, r)
        mesh = mesh.with_boundaries(
            {"inlet": lambda x: x[0] == 0.0, "outlet": lambda x: x[0] == 1.0,
             "wall": lambda x: (x[1] == inner) | (x[1] == outer)}
        )  # fmt: skip
        space = taylor_hood(mesh, Symmetry.AXIAL)
        ends = [held(space, "wall"), straight(space, "inlet"), straight(space, "outlet")]
        flow = solve_stokes(FlowProblem(space, 1.0, together(ends), body_force(space, pushed)))
        return flux(flow, "outlet")

    def pushed(x):
        return np.stack([np.ones_like(x[0]), np.zeros_like(x[0])])

    found = refine(drop, (2, 4, 8), order=4.0)
    exact = np.pi / 8.0 * (outer**4 - inner**4 - (outer**2 - inner**2) ** 2 / ring)
    validation(
        case="Stokes reference: flow through an annulus",
        source="closed form (Bird, Stewart, Lightfoot 2002, 2.4)",
        quantity="flow at a pressure gradient and viscosity of one, radii 1 and 3",
        unit="1",
        expected=exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("kind", [lambda n: channel_mesh(1.0, 1.0, n, n), triangles], ids=["quads", "triangles"])
def test_manufactured_stokes_flow_converges(kind):
    """u = curl of sin^2(pi x) sin^2(pi y)/pi, p = cos(pi x) sin(pi y), viscosity 2."""

    def velocity(x):
        s, c = np.sin(np.pi * x), np.cos(np.pi * x)
        return np.stack([2.0 * s[0] ** 2 * s[1] * c[1], -2.0 * s[1] ** 2 * s[0] * c[0]])

    def pressure(x):
        return np.cos(np.pi * x[0]) * np.sin(np.pi * x[1])

    def force(x):
        a, b = 2.0 * np.pi * x
        laplace_x = 2.0 * np.pi**2 * (2.0 * np.cos(a) - 1.0) * np.sin(b)
        laplace_y = -2.0 * np.pi**2 * (2.0 * np.cos(b) - 1.0) * np.sin(a)
        slope = np.pi * np.stack([-np.sin(a / 2) * np.sin(b / 2), np.cos(a / 2) * np.cos(b / 2)])
        return slope - 2.0 * np.stack([laplace_x, laplace_y])

    found = np.array(
        [errors(solve_stokes(enclosed(kind(n), 2.0, velocity, force)), velocity, pressure) for n in (8, 16)]
    )
    orders = np.log2(found[0] / found[1])
    assert orders[0] > 2.8, orders
    assert orders[1] > 1.8, orders


def test_kovasznay_flow_converges():
    """Behind a grid at Re = 40: Kovasznay (1948), Proc. Camb. Phil. Soc. 44, an exact solution."""
    number = 40.0
    decay = number / 2.0 - np.sqrt(number**2 / 4.0 + 4.0 * np.pi**2)

    def velocity(x):
        wake, y = np.exp(decay * x[0]), 2.0 * np.pi * x[1]
        return np.stack([1.0 - wake * np.cos(y), decay / (2.0 * np.pi) * wake * np.sin(y)])

    def pressure(x):
        return 0.5 * (1.0 - np.exp(2.0 * decay * x[0]))

    found = []
    for n in (6, 12):
        mesh = channel_mesh(1.0, 1.0, n, n)
        (flow,) = solve_navier_stokes(enclosed(mesh, 1.0 / number, velocity), [1.0])
        found.append(errors(flow, velocity, pressure))
    orders = np.log2(np.array(found[0]) / np.array(found[1]))
    assert orders[0] > 2.7, orders
    assert orders[1] > 1.8, orders


def backward_step(cells, numbers, lengths, inlet=True):
    """Flows over a step of one in a channel of two, at Re = 2 u/nu with u the mean velocity ahead of it."""
    mesh = step_mesh((1.0, 2.0), lengths, cells)
    space = taylor_hood(mesh)
    parabola = held(space, "inlet", lambda x: np.stack([6.0 * x[1] * (1.0 - x[1]), 0.0 * x[1]]))
    problem = FlowProblem(space, 1.0, together([held(space, "wall"), parabola, straight(space, "outlet")]))
    return solve_navier_stokes(problem, [0.5 * number for number in numbers])


def test_backward_step_reattaches(validation):
    published = {100: 2.922, 200: 4.982}
    flows = backward_step(4, published, (4.0, 14.0))
    for flow, (number, expected) in zip(flows, published.items(), strict=True):
        validation(
            case="Stokes reference: flow over a backward step",
            source="Erturk 2008, Computers and Fluids 37, table 3",
            quantity=f"reattachment behind the step at Re {number}",
            unit="step heights",
            expected=expected,
            obtained=turning_places(flow, 2.0)[-1],
            relative_tolerance=0.01,
            note="4 cells a step height; published: second-order differences of 1/100",
        )


def test_a_fluid_at_rest_stays_at_rest():
    """No wall moves: inertia changes nothing, and no change is compared with a velocity of zero."""
    (flow,) = solve_navier_stokes(enclosed(triangles(3), 1.0, lambda x: 0.0 * x), [10.0])
    assert flow.density == 10.0
    assert not flow.velocity.any()


def test_no_steady_flow_is_told():
    with pytest.raises(FilmNotConverged, match="no steady flow found beyond a density of"):
        backward_step(1, [1e6], (2.0, 3.0))


def test_impossible_flows_are_refused():
    space = taylor_hood(channel_mesh(1.0, 1.0, 1, 1))
    with pytest.raises(FilmInputError, match="viscosity: found 0 Pa s"):
        FlowProblem(space, 0.0, held(space, "wall"))
    with pytest.raises(FilmInputError, match="two that differ"):
        step_mesh((1.0, 1.0), (2.0, 2.0), 4)


def test_graded_places_grow_gently():
    places = graded(1.0, 4.0, 0.01, 0.1, 0.2)
    sizes = np.diff(places)
    assert (places[0], places[-1]) == (1.0, pytest.approx(4.0))
    assert np.all(sizes[1:] / sizes[:-1] < 1.5)
    assert np.all(sizes[:-1] / sizes[1:] < 2.1)
    assert sizes[0] < 0.011
