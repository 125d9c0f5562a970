"""Explanations: hypotheses screened, refitted, combined, held out."""
