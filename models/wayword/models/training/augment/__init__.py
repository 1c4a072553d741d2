"""Makes many training sentences of each hand-written one: other numbers, units, places, sides, registers, noise."""
