"""Verdict: claims and their certainty."""
