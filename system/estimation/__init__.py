"""Estimation: parameters with priors, readings with noise, and what the one says about the other.

    parameters, observations, simulator: what goes in;  whitening -> posterior -> fit: what comes out
    evidence: how well a hypothesis stands;  determined: what the readings leave open

Knows no pump: any simulator with named parameters plugs in.
"""
