"""Improve the profile of a slider land by the gradient of its load: from a wedge towards Rayleigh's step (1918).

    python examples/films/shape_by_gradient.py [--picture FILE.png]

Each step moves the film of every cell along the derivative of the load, never below the least film. One film and one
transposed solve give the derivatives by all 64 thicknesses. No profile bears more than Rayleigh's step,
0.2064 mu U B^2/h^2 per width; the best wedge bears 0.1602.
"""

import sys
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from reynolds import ZERO, Cell, FilmProblem, FilmSolver, Held, LoadOutput, film, film_gradients, film_space, rectangle

LEAST, LONGEST_STEP, STEPS = 10e-6, 0.8e-6, 30  # m, m
LENGTH, SPEED, VISCOSITY = 0.01, 1.0, 0.03  # m, m/s, Pa s

space = film_space(rectangle((LENGTH, LENGTH), (64, 1), cell=Cell.QUADRILATERAL, periodic_y=True))
middle = space.points[0].mean(axis=1, keepdims=True)
wedge = film(LEAST * (2.2 - 1.2 * middle / LENGTH), VISCOSITY, velocity_moving=(np.full((1, 1), SPEED), ZERO))
problem = FilmProblem(space, wedge, {"left": Held(0.0), "right": Held(0.0)})
solver = FilmSolver(space)
unit = VISCOSITY * SPEED * LENGTH**2 / LEAST**2 * LENGTH
shapes = {}
for step in range(STEPS + 1):
    (load,) = film_gradients(solver, solver.solve(problem), [LoadOutput()])
    if step % 10 == 0:
        shapes[f"step {step}: {load.value:.1f} N"] = problem.film.thickness.mean(axis=1)
        print(f"step {step:2d}: load {load.value:.2f} N, {load.value / unit:.4f} mu U B^2/h^2 per width")
    thickness, slope = problem.film.thickness, load.at_points.mean(axis=1, keepdims=True)
    slope[(thickness <= LEAST) & (slope < 0.0)] = 0.0
    thickness = np.maximum(thickness + LONGEST_STEP * slope / np.abs(slope).max(), LEAST)
    problem = replace(problem, film=replace(problem.film, thickness=thickness))
print("profile, um:", np.round(1e6 * thickness[::8, 0], 1))

if __name__ == "__main__" and sys.argv[1:2] == ["--picture"]:
    figure = Figure(figsize=(7.2, 4.0), layout="constrained")
    axes = figure.subplots()
    for name, shape in shapes.items():
        axes.plot(1e3 * middle[:, 0], 1e6 * shape, label=name)
    axes.set(xlabel="along the slider [mm]", ylabel="film thickness [um]", ylim=(0.0, None))
    axes.legend()
    figure.savefig(sys.argv[2], dpi=110)
