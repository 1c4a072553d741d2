"""What every driver needs of the world to decide: the clock, the lights, and who is where."""

from dataclasses import dataclass, field

from wayword.runtime.world.maps import SignalTiming
from wayword.runtime.world.network import Network
from wayword.runtime.world.occupancy import Occupancy
from wayword.runtime.world.signals import Signals


@dataclass(slots=True)
class Scene:
    """The true world, apart from the cars' own states.

    Attributes:
        network: The lane graph.
        signals: The traffic lights.
        timing: Their timing, as drivers know it from experience.
        occupancy: Which cars are on which lane.
        time_s: Simulated time.
    """

    network: Network
    signals: Signals
    timing: SignalTiming
    occupancy: Occupancy = field(default_factory=Occupancy)
    time_s: float = 0.0
