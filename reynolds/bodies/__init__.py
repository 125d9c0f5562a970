"""The walls of a film as elastic, heated bodies.

Bodies are slow beside their film: heat is steady (a body's time constant L^2/a is seconds to minutes, the film's
is milliseconds), and elastic bodies have no inertia of vibration.
"""
