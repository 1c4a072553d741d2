"""The names that the language document gives the places of the town (section 6)."""

TOWN = (
    "Campus Building",
    "Main Station",
    "City Hall",
    "Hospital",
    "Museum",
    "Stadium",
    "Supermarket",
    "Library",
    "Harbor",
    "Home",
)
