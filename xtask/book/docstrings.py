"""Prints the docstrings of the Python package as Markdown, from its sources, for the book."""

import re

import griffe
import griffe2md

package = griffe.load("softstop", search_paths=["python"], docstring_parser="numpy")
text = griffe2md.render_object_docs(package, {
    "inherited_members": False,
    "line_length": 90,
    "show_if_no_docstring": False,
    "show_root_heading": False,
    "show_signature_annotations": True,
    "summary": {"classes": True, "functions": True, "modules": True},
})
headings = set(re.findall(r"^#+ `(.*)`$", text, flags=re.M))


def link(found):
    """A link to a heading, or the words alone where there is none."""
    name = re.sub(r"\._\w+\.", ".", found[2])
    return f"[{found[1]}](#{name})" if name in headings else found[1]


text = re.sub(r"\[([^][]*)\]\(#([\w.]+)\)", link, text)
text = re.sub(r"^(#+ `(.*)`)$", r"\1 {#\2}", text, flags=re.M)
text = re.sub(r"(?<=\n\n)>>> .*(?:\n(?!\n).*)*", r"```pycon\n\g<0>\n```", text)
print(text)
