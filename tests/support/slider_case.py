"""Case of a slider of inclination 2, as the text of its file."""


def slider_case(size: str, cells: str) -> str:
    """The case, periodic along y; size: lengths with units, cells: numbers along x and y, each as in a list."""
    return f"""
format = 1
[film]
mesh = {{ kind = "rectangle", size = [{size}], cells = [{cells}], periodic = "y" }}
thickness = "1e-5*(2 - x/0.01)"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
[boundary]
left = {{ pressure = "0 bar" }}
right = {{ pressure = "0 bar" }}
"""
