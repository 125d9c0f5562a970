"""The catalogue of effects, with priors and channels."""
