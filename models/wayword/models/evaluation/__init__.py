"""How well instructions are translated: accuracy, false activations, attacks, confidence, ablations."""
