"""The physics that loss models leave out, as extensions of the pump model that can be switched on.

effects: the catalogue's ids, what a law sees and what it changes;  extension: a law with its parameters
"""
