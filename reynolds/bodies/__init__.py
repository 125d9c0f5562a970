"""The walls of a film as elastic, heated bodies.

    body_mesh, body_file -> body_space -> elasticity, conduction -> face operators (kept by `cache`)
    chart, transfer: film plane <-> loaded face;  wall: a body under a film;  foundation: walls without a mesh

Bodies are slow beside their film: heat is steady (a body's time constant L^2/a is seconds to minutes, the film's
is milliseconds), and elastic bodies have no inertia of vibration.
"""
