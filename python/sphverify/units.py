# SPDX-License-Identifier: GPL-3.0-or-later
"""Units, as the schema of results documents gives them."""

UNITS = {
    # fields: of their errors, scales and floors too
    "density": "kg/m^3",
    "velocity": "m/s",
    "pressure": "Pa",
    "internal_energy": "J/kg",
    "temperature": "K",
    "flux": "W/m^2",
    "acceleration": "m/s^2",
    "heating": "W/kg",
}

# Fields with a number for each axis, in one dimension too.
VECTORS = {"velocity", "flux", "acceleration"}
