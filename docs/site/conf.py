"""Configuration of the documentation site: `make docs` builds it into build/site, without a network."""

import sys
import tomllib
from pathlib import Path

import numba

numba.config.DISABLE_JIT = True  # compiled functions keep their docstrings and signatures

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

project = "Swashfilm"
author = "The Swashfilm founders"
copyright = f"{author}, MIT licence"
release = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton", "docstrings", "pages"]

root_doc = "docs/index"
include_patterns = ["docs/**", "examples/**", "meshes/README.md", "benchmarks/concealed/README.md", "*.md"]
exclude_patterns = ["docs/site/*", "docs/paper.md", "**/__pycache__"]

myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
suppress_warnings = ["ref.python"]  # a type in quotation marks may name a public object and its module's
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100

html_theme = "furo"
html_title = f"Swashfilm {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
