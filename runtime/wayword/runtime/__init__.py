"""The runtime: a simulated world, the driving stack's seam, validator, executor, co-pilot, scenarios and records."""
