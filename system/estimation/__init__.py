"""Estimation: parameters with priors, readings with noise, and what the one says about the other.

    parameters, observations, simulator: what goes in;  whitening -> posterior (linear), fit (peak): what comes out
    laplace, evidence: how well hypotheses stand;  predictive: readings not fitted;  determined: what is left open

Knows no pump: any simulator with named parameters plugs in.
"""
