"""The interactive page, opened from Python."""

import json
import urllib.error
import urllib.request
from typing import Any

import numpy as np
import pytest

import asperity as asp
from asperity.page import Page

ROUGH = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.03, rms_gradient=0.1)


def asked(page: Page, path: str, body: bytes | None = None) -> bytes:
    """What a browser gets: it opens the address with the key, and has a cookie from then on."""
    browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
    browser.open(page.address, timeout=20).close()
    request = urllib.request.Request(page.address.split("?")[0] + path, body, {"Content-Type": "application/json"})
    with browser.open(request, timeout=20) as answer:
        return bytes(answer.read())


def knobs(page: Page) -> Any:
    """The controls with which the page begins."""
    session = json.loads(asked(page, "api/session", b"0"))["session"]
    return json.loads(asked(page, f"session/{session}/api/start"))


def test_the_page_opens_on_a_contact_and_ends() -> None:
    contact = asp.solve(asp.Surface.rough(512, 1.0, **ROUGH), reduced_pressure=0.07)
    with asp.explore(contact, port=0, open_browser=False) as page:
        assert b"<title>" in asked(page, "") and page.address in page._repr_html_()
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(page.address.split("?")[0], timeout=20)
        assert knobs(page)["load"] == pytest.approx(0.07)
    with pytest.raises(OSError):
        asked(page, "")


def test_the_page_opens_on_an_array_a_surface_and_a_setup() -> None:
    x = np.arange(256) / 256
    heights = 0.01 * np.cos(2 * np.pi * x) + 1e-3 * np.cos(34 * np.pi * x)
    surface = asp.Surface(heights, 1.0)
    for what in (asp.Problem(surface, reduced_pressure=0.1), surface, asp.Problem(asp.Surface.rough(512, 1.0, **ROUGH), reduced_pressure=0.1).setup):
        with asp.explore(what, port=0, open_browser=False) as page:
            assert knobs(page)["load"] == pytest.approx(0.05 if what is surface else 0.1)


def test_what_the_page_cannot_show_is_refused() -> None:
    curve = asp.Problem(asp.Surface.rough(512, 1.0, **ROUGH), reduced_pressure=[0.1, 0.2])
    with pytest.raises(asp.AsperityError, match="one load at a time"):
        asp.explore(curve, port=0, open_browser=False)
    with pytest.raises(asp.AsperityError, match="give a Setup, a Problem, a Contact or a Surface"):
        asp.explore("scene.toml", port=0, open_browser=False)  # type: ignore[arg-type]
