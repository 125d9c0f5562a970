"""Loss models of the literature by name: what a pump lacks in flow and takes in torque beyond the ideal one.

points: what they hang on;  model: terms that are linear in their coefficients;  one file a model;
catalogue: by name;  bench: a model as a simulator that is fitted as any other
"""
