"""Estimation: parameters with priors, readings with noise, fit, evidence and posterior.

Knows no pump: any simulator with named parameters can be fitted.
"""
