"""Errors of the model stages."""


class ModelError(Exception):
    """Weights that aren't there or can't be loaded. The message says what to do."""
