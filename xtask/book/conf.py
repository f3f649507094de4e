"""Settings of Sphinx for the book in HTML (`cargo xtask docs`).

The pages are those of the repository, as they stand: CommonMark, read by MyST. Formulas are written in Unicode and need
no typesetting. Nothing in it is fetched from elsewhere.
"""

import os
import sys

from pygments.lexers.special import TextLexer

sys.path.insert(0, os.environ["GYRATION_REFERENCE"])

project = "Gyration"
author = "The Gyration developers"
version = release = os.environ["GYRATION_VERSION"]
html_title = f"Gyration {version}"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_copybutton"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
# Blocks of code without a language are formulas, listings and output.
highlight_language = "none"
# What stands between single backticks in doc comments of Rust.
default_role = "code"

# The marks by which pages refer to headings of others, made as forges make them.
myst_heading_anchors = 4
# Of MyST's additions to CommonMark: none. What reads well here reads well anywhere.
myst_enable_extensions = []

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_maximum_signature_line_length = 80
python_use_unqualified_type_names = True
add_module_names = False

html_theme = "furo"
html_static_path = ["static", os.environ["GYRATION_FONTS"]]
html_css_files = ["book.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
templates_path = ["templates"]
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/search.html",
        "page-link.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_context = {"has_page": os.environ["GYRATION_HAS_PAGE"] == "yes"}
# Formulas and output are not copied: only what is typed is.
copybutton_selector = "div:not(.highlight-none) > div.highlight > pre"


def setup(app):
    """Makes a language of the blocks that a test reads (`order`) known: plain text."""
    app.add_lexer("order", TextLexer)
    app.add_lexer("csv", TextLexer)
