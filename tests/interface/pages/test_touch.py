"""Figures of a page that can be touched, in a browser without network: hover, choices, units, views, static form."""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from blank_pictures import rendered_figures
from PIL import Image

import swashfilm as sf
from swashfilm.output.answer import Answer, Tile
from swashfilm.output.figures import figure_of
from swashfilm.output.page import inlined, write_page
from swashfilm.output.touch.curves import touchable
from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.meshes import coarsened
from swashfilm.output.touch.packing import packed
from swashfilm.output.touch.relief import ReliefField, relief
from swashfilm.runs.map.explorer import map_explorer
from swashfilm.runs.pump.scene.view import motion, pump_view
from system.maps.data import MapData, objects
from system.maps.plan import MapAxis, MapInput
from system.maps.point import columns

LARGEST = 3_000_000
"""Bytes of a page."""
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
SOFTWARE_WEBGL = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PATIENCE = 60_000  # ms
ANGLE = np.linspace(0.0, 360.0, 181)
PRESSURE = 17.2345 + 16.5 * np.sin(np.radians(ANGLE))
NAME = "</script><script>throw 1</script>"
in_browser = pytest.mark.skipif(
    CHROMIUM is None or importlib.util.find_spec("playwright") is None,
    reason="needs Chromium (Debian: apt-get install chromium) and Playwright for Python (extra dev)",
)


def curve_figure() -> Any:
    figure = figure_of(8.0, 3.0)
    axes = figure.subplots()
    axes.plot(ANGLE, PRESSURE, color="#1c2328", label=NAME)
    axes.set(xlabel="shaft angle [deg]", ylabel="pressure, gauge [MPa]", xlim=(0, 360))
    axes.legend()
    return figure


def map_data() -> MapData:
    axes = (
        MapAxis(MapInput.SPEED, (100.0, 150.0, 200.0)),
        MapAxis(MapInput.PRESSURE, (1e7, 2e7, 3e7)),
        MapAxis(MapInput.RATIO, (0.5, 1.0)),
        MapAxis(MapInput.TEMPERATURE, (323.15,)),
        MapAxis(MapInput.INLET_PRESSURE, (2.5e6,)),
    )
    speed, pressure, ratio, *_ = np.meshgrid(*(axis.values for axis in axes), indexing="ij")
    values = {column: 1e-3 * speed * ratio + 1e-12 * pressure * speed for column, *_ in columns()}
    values |= {
        "shaft_power": 1.2e-5 * pressure * speed * ratio, "hydraulic_power": 1e-5 * pressure * speed * ratio,
        "port_delivery_pressure": pressure, "port_inlet_pressure": 0.0 * pressure, "shaft_torque": pressure * 1e-5,
    }  # fmt: skip
    text = [np.full(speed.shape, word) for word in ("solved", "")]
    remarks = objects([()] * speed.size, speed.shape)
    return MapData("toy", "closed form", 1.6e9, axes, values, *text, remarks, {})


def film_explorer() -> Explorer:
    x, y = (one.ravel() for one in np.meshgrid(np.arange(5.0), np.arange(4.0)))
    corner = np.array([k + 5 * row for row in range(3) for k in range(4)])
    cells = np.stack([corner, corner + 1, corner + 6, corner + 5], axis=1)
    states = np.arange(1.0, 4.0)[:, None]
    fields = [
        ReliefField("film pressure [MPa]", states * (1.0 + x * y)),
        ReliefField("film thickness [um]", 5.0 / states + x),
    ]
    return relief((np.tile(x, (3, 1)), np.tile(y, (3, 1))), cells, fields, ("0 deg", "120 deg", "240 deg"))


def write_scene(folder: Path) -> None:
    """Write blocks of a pump at three angles: a block that turns, pistons and slippers that change places, films."""
    (folder / "pump").mkdir(parents=True)
    (folder / "fields").mkdir()
    square = np.array([[0.0, 0.0, 0.0], [0.02, 0.0, 0.0], [0.02, 0.02, 0.0], [0.0, 0.02, 0.01]])
    for k, turned in enumerate(np.radians([0.0, 120.0, 240.0])):
        c, s = np.cos(turned), np.sin(turned)
        points = square @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T
        fields = {"film_pressure [Pa]": 1e6 * (k + np.arange(4.0)), "film_thickness [m]": np.full(4, 1e-5 * (k + 1))}
        meshio.write_points_cells(folder / f"pump/part_{k:03d}.vtu", points, [("quad", [[0, 1, 2, 3]])])
        meshio.write_points_cells(
            folder / f"fields/film_{k:03d}.vtu",
            points + np.array([0.0, 0.0, 1e-3 * k]),
            [("quad", [[0, 1, 2, 3]])],
            fields,
        )
        files = {"block": f"pump/part_{k:03d}", "block film": f"fields/film_{k:03d}"}
        for number, at in ((1, k), (2, (k + 1) % 3)):
            for part in ("piston", "slipper"):
                files |= {f"{part} {number}": f"pump/part_{at:03d}", f"{part} {number} film": f"fields/film_{at:03d}"}
        rows = "".join(f'<DataSet name="{name}" file="../{file}.vtu"/>' for name, file in files.items())
        angle = f"<FieldData><DataArray>{np.degrees(turned):g}</DataArray></FieldData>"
        text = f"<VTKFile><vtkMultiBlockDataSet>{rows}</vtkMultiBlockDataSet>{angle}</VTKFile>"
        (folder / f"pump/pump_{k:03d}.vtm").write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with a curve, a map, a film over the turn and a pump in space, each with its static picture."""
    folder = tmp_path_factory.mktemp("touch")
    write_scene(folder)
    view = pump_view(folder)
    assert view is not None
    explorers = {"curve": None, "map": map_explorer(map_data()), "film": film_explorer(), "pump": view}
    with rendered_figures():
        pictures = {name: inlined(curve_figure(), explorer) for name, explorer in explorers.items()}
    summary = {"solved": 1, "points": 1, "assumptions": []}
    content = {"pictures": pictures, "rows": [], "failed": [], "case": NAME, "summary": summary}
    return write_page(folder, "study", answer=Answer((Tile("1 N", NAME),), NAME), name=NAME, **content)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE_WEBGL)
        yield found
        found.close()


Opener = Callable[..., Any]


def opened_in(browser: Any, page: Path, faults: list[str], **how: Any) -> Any:
    """Return a tab of its own with the page, without network; faults on its console are added to `faults`."""
    context = browser.new_context(**{"offline": True, "viewport": {"width": 1200, "height": 900}} | how)
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE)
    tab.on("console", lambda message: faults.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda fault: faults.append(str(fault)))
    tab.goto(page.as_uri())
    return tab


@pytest.fixture(scope="module")
def kept(browser: Any, page: Path) -> Iterator[tuple[Any, list[str]]]:
    """Return the page as it is usually opened, with the faults on its console: drawing it anew takes seconds."""
    faults: list[str] = []
    tab = opened_in(browser, page, faults)
    yield tab, faults
    tab.context.close()


@pytest.fixture
def tab(kept: tuple[Any, list[str]]) -> Iterator[Any]:
    """Return the page that these tests share, its unit and medium as at first; a fault on the console fails a test."""
    tab, faults = kept
    yield tab
    tab.emulate_media(media="screen")
    tab.locator('[name="pressure unit"]').select_option("MPa")
    assert not faults


@pytest.fixture
def opened(browser: Any, page: Path) -> Iterator[Opener]:
    """Open the page in another way; a test that leaves a fault on the console fails."""
    faults: list[str] = []
    tabs = []

    def open_page(**how: Any) -> Any:
        tabs.append(opened_in(browser, page, faults, **how))
        return tabs[-1]

    yield open_page
    for one in tabs:
        one.context.close()
    assert not faults


def drawn(tab: Any, name: str) -> Any:
    """Return the figure of that name, scrolled into view and drawn; a picture of it lies beside the page."""
    figure = tab.locator("figure", has=tab.locator("figcaption", has_text=name))
    figure.scroll_into_view_if_needed()
    figure.locator(".plot[data-draws]").wait_for()
    return figure


def told(figure: Any, expression: str) -> Any:
    """Return what an expression of the plotly figure `plot` gives in the browser."""
    return figure.locator(".plot").evaluate(f"plot => {expression}")


def hover(figure: Any, trace: int, point: int) -> str:
    """Move the mouse onto a point of a curve or of marks; return what appears."""
    plot = figure.locator(".plot")
    x, y = told(
        figure,
        f"(() => {{ const full = plot._fullData[{trace}], axes = plot._fullLayout,"
        " x = axes['xaxis'], y = axes['yaxis']; return"
        f" [x._offset + x.l2p(full.x[{point}]), y._offset + y.l2p(full.y[{point}])]; }})()",
    )
    box = plot.bounding_box()
    plot.page.mouse.move(box["x"] + x + 1.0, box["y"] + y + 1.0)
    plot.page.mouse.move(box["x"] + x, box["y"] + y)
    label = figure.locator(".hoverlayer .hovertext").first
    label.wait_for()
    return str(label.text_content())


def choose(figure: Any, name: str, option: int) -> None:
    """Set a slider or a list to its n-th option."""
    control = figure.locator(f'[name="{name}"]')
    before = told(figure, "plot.dataset.draws")
    control.evaluate(
        "(one, n) => { if (one.type === 'range') one.value = n; else one.selectedIndex = n;"
        " one.dispatchEvent(new Event('input')); }",
        option,
    )
    figure.page.wait_for_function(
        "([plot, n]) => plot.dataset.draws !== n", arg=[figure.locator(".plot").element_handle(), before]
    )


@in_browser
def test_hovering_over_a_curve_tells_the_number_of_its_table(tab: Any) -> None:
    text = hover(drawn(tab, "curve"), 0, 45)
    assert f"pressure, gauge [MPa]: {PRESSURE[45]:.6g}" in text
    assert "shaft angle [deg]: 90" in text


@in_browser
def test_the_unit_switch_multiplies_pressures_by_ten(tab: Any) -> None:
    figure = drawn(tab, "curve")
    before = told(figure, "[plot.data[0].y[45], plot.layout.yaxis.range[1]]")
    assert told(figure, "plot.layout.yaxis.title.text") == "pressure, gauge [MPa]"
    tab.locator('[name="pressure unit"]').select_option("bar")
    tab.wait_for_function("document.querySelector('.plot').layout.yaxis.title.text.endsWith('[bar]')")
    after = told(figure, "[plot.data[0].y[45], plot.layout.yaxis.range[1]]")
    assert after == pytest.approx([10.0 * value for value in before])
    assert "[bar]: " in hover(figure, 0, 45)


@in_browser
def test_a_page_with_figures_in_bar_has_all_of_them_in_bar(browser: Any, tmp_path: Path) -> None:
    """Whichever comes first; the list says the unit of every figure, and MPa makes those in bar MPa, too."""
    readings = curve_figure()
    readings.axes[0].set_ylabel("delivery pressure [bar]")
    readings.axes[0].set_yticks([10.0, 30.0], ["10", "30"])
    with rendered_figures():
        pictures = {"first": inlined(curve_figure()), "second": inlined(readings)}
    summary = {"solved": 1, "points": 1, "assumptions": []}
    content = {"pictures": pictures, "rows": [], "failed": [], "case": NAME, "summary": summary}
    path = write_page(tmp_path, "study", answer=Answer((), NAME), name=NAME, **content)
    faults: list[str] = []
    tab = opened_in(browser, path, faults, viewport={"width": 1200, "height": 2400})
    titles = "[...document.querySelectorAll('.plot')].map((plot) => plot.layout?.yaxis.title.text.split('[')[1]).join()"
    for unit, size in (("bar", 1.0), ("MPa", 0.1)):
        tab.wait_for_function(f"{titles} === '{unit}],{unit}]'")
        assert tab.locator('[name="pressure unit"]').input_value() == unit
        read = tab.evaluate("document.querySelectorAll('.plot')[1].data[0].y[45]")
        assert read == pytest.approx(size * PRESSURE[45], rel=1e-5)
        texts = tab.evaluate("document.querySelectorAll('.plot')[1].layout.yaxis.ticktext ?? null")
        assert texts == (["10", "30"] if unit == "bar" else None)
        tab.locator('[name="pressure unit"]').select_option("MPa")
    tab.context.close()
    assert not faults


@in_browser
def test_a_table_wider_than_its_screen_shows_that_it_goes_on(browser: Any, tmp_path: Path) -> None:
    """The right edge of a table that is cut is darker than the page; that of a whole one is not."""
    row = [f"number_{at}_of_a_table" for at in range(5)]
    content = {"name": NAME, "case": NAME, "summary": {"solved": 1, "points": 1, "assumptions": []}, "failed": []}
    path = write_page(tmp_path, "study", answer=Answer((), NAME), pictures={}, rows=[row] * 30, **content)
    for width, cut in ((400, True), (1400, False)):
        tab = opened_in(browser, path, [], viewport={"width": width, "height": 900})
        table = tab.locator(".wide").first
        assert table.evaluate("(own) => own.scrollWidth > own.clientWidth") is cut
        picture = np.asarray(Image.open(BytesIO(table.screenshot())).convert("L"))
        assert bool(np.median(picture[:, -2]) < 230) is cut
        tab.context.close()


@in_browser
def test_the_third_axis_of_a_map_changes_its_slice(tab: Any) -> None:
    figure = drawn(tab, "map")
    before = told(figure, "plot.data[0].z.flat()")
    choose(figure, "displacement ratio", 0)
    after = told(figure, "plot.data[0].z.flat()")
    assert not np.allclose(before, after)


@in_browser
def test_another_pair_of_axes_hides_its_sliders_and_offers_the_third(tab: Any) -> None:
    figure = drawn(tab, "map")
    assert figure.locator('[name="displacement ratio"]').is_visible()
    assert not figure.locator('[name="shaft speed"]').is_visible()
    axes = figure.locator('[name="axes"]')
    names = axes.locator("option").all_text_contents()
    choose(figure, "axes", names.index("displacement ratio over delivery pressure"))
    assert figure.locator('[name="shaft speed"]').is_visible()
    assert told(figure, "plot.layout.yaxis.title.text") == "displacement ratio"
    choose(figure, "axes", 0)  # as other tests expect it


@in_browser
def test_a_solved_point_of_a_map_has_the_number_of_its_table(tab: Any) -> None:
    figure, data = drawn(tab, "map"), map_data()
    names = figure.locator('[name="quantity"] option').all_text_contents()
    choose(figure, "quantity", names.index("shaft torque [N m]"))
    expected = f"{data.values['shaft_torque'][1, 1, 1, 0, 0]:.8g}"
    assert f"shaft torque [N m]: {expected}" in hover(figure, 1, 4)


@in_browser
def test_the_slider_over_the_shaft_angle_moves_the_field(tab: Any) -> None:
    figure = drawn(tab, "film")
    highest = []
    for angle in range(3):
        choose(figure, "shaft angle", (angle + 1) % 3)
        choose(figure, "shaft angle", angle)
        highest.append(told(figure, "Math.max(...plot.data[0].intensity)"))
    assert highest == pytest.approx([13.0, 26.0, 39.0])
    choose(figure, "field", 1)
    assert told(figure, "plot.data[0].colorbar.title.text") == "film thickness [um]"


@in_browser
def test_the_pump_in_space_has_its_meshes_and_turns_with_the_slider(tab: Any) -> None:
    figure = drawn(tab, "pump")
    names = told(figure, "plot.data.map(trace => `${trace.type} ${trace.name} ${trace.x.length} ${trace.i?.length}`)")
    parts = [f"mesh3d {part}{of} 8 4" for part in ("piston", "slipper") for of in ("", " film")]
    assert sorted(names) == ["mesh3d block 4 2", "mesh3d block film 4 2", *parts, "scatter3d chambers 2 undefined"]
    block = names.index("mesh3d block 4 2")
    choose(figure, "shaft angle", 0)
    before = told(figure, f"plot.data[{block}].x")
    choose(figure, "shaft angle", 1)
    after = told(figure, f"plot.data[{block}].x")
    numbers = names.index("scatter3d chambers 2 undefined")
    assert told(figure, f"plot.data[{numbers}].text") == ["1", "2"]
    first, second = told(figure, f"plot.data[{numbers}].x")
    choose(figure, "shaft angle", 2)
    assert told(figure, f"plot.data[{numbers}].x")[0] == second != first  # where the other was
    assert not np.allclose(before, after)
    assert told(figure, "plot.data[0].showscale")


@in_browser
def test_figures_are_drawn_as_they_come_into_view(opened: Opener) -> None:
    tab = opened(viewport={"width": 480, "height": 200})
    drawn(tab, "curve")
    assert tab.locator(".plot").count() < 4
    for name in ("curve", "map", "film", "pump"):
        drawn(tab, name)
    assert tab.locator(".plot[data-draws]").count() == 4


@in_browser
def test_without_scripts_the_static_pictures_stay(opened: Opener) -> None:
    tab = opened(java_script_enabled=False)
    assert tab.locator("figure img:visible").count() == 4
    assert tab.locator(".plot, .units").count() == 0


@in_browser
def test_the_static_pictures_are_printed(tab: Any) -> None:
    figure = drawn(tab, "curve")
    assert not figure.locator("img").is_visible()
    tab.emulate_media(media="print")
    assert figure.locator("img").is_visible()
    assert not figure.locator(".plot").is_visible()


@in_browser
def test_ink_and_text_follow_the_readers_dark(opened: Opener) -> None:
    figure = drawn(opened(color_scheme="dark"), "curve")
    assert told(figure, "plot.data[0].line.color") == told(figure, "plot.layout.font.color") == "#e4e8ea"


@in_browser
def test_pictures_of_the_figures_for_review(tab: Any, page: Path) -> None:
    for name in ("curve", "map", "film", "pump"):
        drawn(tab, name).screenshot(path=page.with_name(f"{name}.png"))
    print(f"pictures of the figures: {page.parent}")
    assert (page.with_name("pump.png")).stat().st_size > 5_000


def test_a_page_is_small_and_names_cannot_end_its_figures(page: Path) -> None:
    text = page.read_text("utf-8")
    assert len(text.encode()) < LARGEST
    assert NAME not in text


def test_packed_text_has_no_letter_that_html_reads() -> None:
    assert not set("<>&\"'") & set(packed(NAME * 99))


@pytest.mark.parametrize("of", ["patch", "image"])
def test_a_figure_with_anything_else_stays_static(of: str) -> None:
    from matplotlib.patches import Circle

    figure = curve_figure()
    if of == "patch":
        figure.axes[0].add_patch(Circle((0.0, 0.0), 1.0))
    else:
        figure.axes[0].imshow(np.eye(3))
    assert inlined(figure).touch == ""


def test_a_curve_keeps_its_panel_labels_and_limits() -> None:
    figure = curve_figure()
    figure.draw_without_rendering()
    found = touchable(figure)
    assert found is not None
    assert found.layout.xaxis.range == (0.0, 360.0)
    assert found.layout.yaxis.title.text == "pressure, gauge [MPa]"
    assert found.data[0].line.color == "#1c2328"
    assert found.data[0].legend == "legend"


def test_titles_of_a_figure_are_below_its_buttons() -> None:
    """A figure with a title is higher by the buttons, which would cover the title of a narrow one."""
    heights = []
    for title, above in (("", 0), ("B - A / percentage points", 30)):
        figure = curve_figure()
        figure.axes[0].get_legend().remove()
        figure.axes[0].set_title(title)
        figure.draw_without_rendering()
        found = touchable(figure)
        assert found is not None
        assert found.layout.margin.t == above
        heights.append(found.layout.height)
    assert heights[1] == heights[0] + 30


def test_a_legend_at_the_top_of_a_figure_is_below_its_buttons() -> None:
    """Of a panel, above it, and of the figure; one within a panel below the buttons takes no room."""
    for place, above in (("panel", 30), ("figure", 30), ("low", 0)):
        figure = curve_figure()
        handles, names = figure.axes[0].get_legend_handles_labels()
        figure.axes[0].get_legend().remove()
        if place == "panel":
            figure.axes[0].legend(handles, names, loc="lower right", bbox_to_anchor=(1.0, 1.0))
        elif place == "figure":
            figure.legend(handles, names, loc="upper right")
        else:
            figure.axes[0].legend(handles, names, loc="lower left")
        figure.draw_without_rendering()
        found = touchable(figure)
        assert found is not None
        assert found.layout.margin.t == above


@in_browser
def test_the_costs_of_a_sensitivity_fit_a_screen_of_1400_pixels(browser: Any, tmp_path: Path) -> None:
    """Nine columns; without the room to the right of the text and their smaller letters the last ones are cut."""
    found = sf.sensitivity("ref90", keys="valve_plate.*,friction.*,oil.*,ports.*").save(tmp_path / "run")
    tab = opened_in(browser, found / "report.html", [], viewport={"width": 1400, "height": 900})
    beyond = "(() => { const own = document.querySelector('.wide'); return own.scrollWidth - own.clientWidth })()"
    assert tab.evaluate(beyond) == 0
    tab.context.close()


def test_a_long_line_keeps_its_extremes() -> None:
    figure = figure_of(8.0, 3.0)
    x = np.arange(100_000.0)
    y = np.sin(0.01 * x)
    y[77_777] = 5.0
    figure.subplots().plot(x, y)
    figure.draw_without_rendering()
    found = touchable(figure)
    assert found is not None
    assert len(found.data[0].y) <= 2000
    assert max(found.data[0].y) == 5.0


def test_a_coarse_mesh_keeps_vertices_of_the_fine_one() -> None:
    x, y = (one.ravel() for one in np.meshgrid(np.linspace(0, 1, 40), np.linspace(0, 1, 40)))
    corner = np.array([k + 40 * row for row in range(39) for k in range(39)])
    triangles = np.concatenate(
        [np.stack([corner, corner + 1, corner + 41], axis=1), np.stack([corner, corner + 41, corner + 40], axis=1)]
    )
    kept, corners = coarsened(np.stack([x, y], axis=1), triangles, 200)
    assert 100 < len(kept) <= 200
    assert len(set(kept.tolist())) == len(kept)
    assert corners.max() < len(kept)


def test_a_motion_is_found_only_where_a_body_is_rigid() -> None:
    rng = np.random.default_rng(1)
    points = rng.random((20, 3)) * 50.0
    turned = points @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).T + [1.0, 2.0, 3.0]
    found = motion(points, turned)
    assert found is not None
    np.testing.assert_allclose(points @ found[:, :3].T + found[:, 3], turned, atol=1e-9)
    assert motion(points, 1.01 * turned) is None
