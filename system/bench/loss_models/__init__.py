"""Loss models of the literature by name: flow and torque losses of a pump beyond the ideal one.

points: their variables;  model: terms that are linear in their coefficients;  one file a model;
catalogue: by name;  bench: a model as a simulator that is fitted like any other
"""
