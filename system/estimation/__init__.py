"""Estimation: parameters with priors, readings with noise, fit, evidence and posterior.

Independent of pumps: any simulator with named parameters can be fitted.
"""
