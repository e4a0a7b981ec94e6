"""A browser for tests: Chromium over its own debugging protocol, with the websocket of Tornado.

    with Chromium() as browser:
        browser.open(address)
        browser.click("Model")
        browser.wait_for("Equations of motion")

Elements are found by what a user sees: the text of a button or tab, the label of a field. Widgets of Bokeh stand in
shadow roots, which the script below enters.
"""

import asyncio
import base64
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
from itertools import count
from pathlib import Path

PATIENCE = 120.0
"""Seconds to wait for something on the page: test machines are busy."""
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
SCRIPT = """
const all = (root) => [...root.querySelectorAll('*')].flatMap((e) => [e, ...(e.shadowRoot ? all(e.shadowRoot) : [])]);
const seen = (e) => { const r = e.getBoundingClientRect(); return r.width > 0 && r.height > 0; };
const said = (e) => (e.innerText ?? e.textContent ?? '').trim();
const named = (label) => {
  const tag = all(document).find((e) => e.tagName === 'LABEL' && seen(e) && said(e) === label);
  if (!tag) return null;
  const box = tag.getRootNode();
  return (tag.htmlFor && box.getElementById(tag.htmlFor)) || box.querySelector('input, select, textarea');
};
const pressed = (text) => all(document).filter((e) => seen(e) && said(e) === text
  && (e.tagName === 'BUTTON' || e.tagName === 'A' || e.tagName === 'LABEL' || e.tagName === 'SUMMARY'
      || e.classList.contains('bk-tab'))).pop();
const focused = (root) => {
  const e = root.activeElement;
  return e && e.shadowRoot && e.shadowRoot.activeElement ? focused(e.shadowRoot) : e;
};
const called = (e) => {
  if (!e || e === document.body) return '';
  const label = ['INPUT', 'SELECT', 'TEXTAREA'].includes(e.tagName) && (e.closest('label')
    || [...e.getRootNode().querySelectorAll('label')].find((one) => one.htmlFor === e.id));
  return label ? said(label) : said(e);
};
const words = () => all(document).filter((e) => e.shadowRoot === null && seen(e) && e.tagName !== 'STYLE'
  && e.tagName !== 'SCRIPT').flatMap((e) => [...e.childNodes].filter((n) => n.nodeType === 3)
  .map((n) => n.textContent.trim())).filter(Boolean).join(' ');
"""


def find_browser():
    """Return the path of Chromium, or None where there is none."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)


class Chromium:
    """A page in a browser without a window; `requests` are the addresses it asked for, `problems` its errors."""

    def __init__(self, width=1280, height=900, dark=False):
        self.size, self.dark = (width, height), dark
        self.requests, self.problems, self._waiting, self._numbers = [], [], {}, count(1)

    def __enter__(self):
        self._loop = asyncio.new_event_loop()
        self._profile = tempfile.mkdtemp(prefix="lostmotion-browser-")
        words = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"]
        words += ["--disable-background-networking", "--disable-component-update", "--no-first-run"]
        words += ["--remote-debugging-port=0", f"--user-data-dir={self._profile}", "about:blank"]
        self._process = subprocess.Popen(
            [find_browser(), *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        )
        try:
            self._run(self._connect())
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        os.killpg(self._process.pid, signal.SIGKILL)  # with its helpers
        self._process.wait()
        for task in asyncio.all_tasks(self._loop):
            task.cancel()
        self._loop.run_until_complete(asyncio.sleep(0))
        self._loop.close()
        shutil.rmtree(self._profile, ignore_errors=True)

    def _run(self, work):
        return self._loop.run_until_complete(asyncio.wait_for(work, PATIENCE))

    async def _connect(self):
        from tornado.httpclient import AsyncHTTPClient
        from tornado.websocket import websocket_connect

        told = Path(self._profile) / "DevToolsActivePort"
        while not told.is_file() or not told.read_text().strip():
            if self._process.poll() is not None:
                raise RuntimeError(f"the browser ended with status {self._process.returncode}")
            await asyncio.sleep(0.05)
        port = told.read_text().split()[0]
        listed = await AsyncHTTPClient().fetch(f"http://127.0.0.1:{port}/json")
        target = next(one for one in json.loads(listed.body) if one["type"] == "page")
        self._socket = await websocket_connect(target["webSocketDebuggerUrl"], max_message_size=2**28)
        self._reader = self._loop.create_task(self._read())
        for domain in ("Page", "Runtime", "Network", "Log"):
            await self._send(f"{domain}.enable")
        await self._resize()
        theme = [{"name": "prefers-color-scheme", "value": "dark" if self.dark else "light"}]
        await self._send("Emulation.setEmulatedMedia", features=theme)

    async def _resize(self):
        width, height = self.size
        await self._send(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600
        )

    async def _read(self):
        while (text := await self._socket.read_message()) is not None:
            said = json.loads(text)
            if said.get("id") in self._waiting:
                self._waiting.pop(said["id"]).set_result(said)
            elif said.get("method") == "Network.requestWillBeSent":
                self.requests.append(said["params"]["request"]["url"])
            elif said.get("method") == "Network.webSocketCreated":
                self.requests.append(said["params"]["url"])
            elif said.get("method") == "Runtime.exceptionThrown":
                self.problems.append(said["params"]["exceptionDetails"].get("exception", {}).get("description", text))
            elif said.get("method") == "Log.entryAdded" and said["params"]["entry"]["level"] == "error":
                self.problems.append(str(said["params"]["entry"]))

    async def _send(self, method, **params):
        number = next(self._numbers)
        answer = self._waiting[number] = self._loop.create_future()
        await self._socket.write_message(json.dumps({"id": number, "method": method, "params": params}))
        done = await answer
        if "error" in done:
            raise RuntimeError(f"{method}: {done['error']['message']}")
        return done.get("result", {})

    def send(self, method, **params):
        """Return the answer of the browser to a method of its protocol."""
        return self._run(self._send(method, **params))

    def resize(self, width, height):
        """Give the page another size."""
        self.size = (width, height)
        self._run(self._resize())

    def open(self, address):
        """Go to an address, and wait until the page is loaded."""
        self.send("Page.navigate", url=address)
        self.wait("document.readyState === 'complete'")

    def evaluate(self, expression):
        """Return the value of an expression of JavaScript, which may use the functions of `SCRIPT`."""
        code = f"(() => {{ {SCRIPT} return {expression}; }})()"
        done = self.send("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in done:
            raise RuntimeError(f"{expression}: {done['exceptionDetails']}")
        return done["result"].get("value")

    def wait(self, expression, patience=PATIENCE):
        """Return the value of an expression as soon as it is true."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if found := self.evaluate(expression):
                return found
            time.sleep(0.05)
        raise AssertionError(f"{expression} is not true after {patience:g} s; the page says: {self.read()[:3000]}")

    def read(self):
        """Return the words that the page shows."""
        return self.evaluate("words()")

    def wait_for(self, text, patience=PATIENCE):
        """Wait until the page shows a text."""
        self.wait(f"words().includes({json.dumps(text)})", patience)

    def wait_gone(self, text, patience=PATIENCE):
        """Wait until the page no longer shows a text."""
        self.wait(f"!words().includes({json.dumps(text)})", patience)

    def click(self, text):
        """Click on a button, a tab or a link by its text."""
        self._click_on(f"pressed({json.dumps(text)})")

    def _click_on(self, element):
        place = self.wait(
            f"(() => {{ const e = {element}; if (!e) return null; e.scrollIntoView({{block: 'center'}});"
            " const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()"
        )
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", clickCount=1)

    def choose(self, label, option):
        """Choose an option of a list by the label of the list."""
        name, text = json.dumps(label), json.dumps(option)
        self.wait(f"named({name}) && [...named({name}).options].some((o) => o.text.trim() === {text})")
        self.evaluate(
            f"(() => {{ const e = named({name}); e.value = [...e.options].find((o) => o.text.trim() === {text}).value;"
            " e.dispatchEvent(new Event('change', {bubbles: true, composed: true})); return true; })()"
        )

    def type(self, label, text):
        """Replace the content of a field by its label, and leave it."""
        self.wait(f"named({json.dumps(label)}) !== null")
        self.evaluate(f"(() => {{ const e = named({json.dumps(label)}); e.focus(); e.select(); return true; }})()")
        self.send("Input.insertText", text=text)
        self.evaluate(f"(named({json.dumps(label)}).blur(), true)")

    def press(self, key, code=0, modifiers=0):
        """Press a key, such as Tab (9) or Enter (13)."""
        about = {"key": key, "code": key, "windowsVirtualKeyCode": code, "modifiers": modifiers}
        text = {"text": "\r"} if key == "Enter" else {"text": " "} if key == " " else {}
        self.send("Input.dispatchKeyEvent", type="keyDown", **about, **text)
        self.send("Input.dispatchKeyEvent", type="keyUp", **about)

    def tab_to(self, name, most=120):
        """Press Tab until the button, tab or field with a name has the focus."""
        seen = []
        for _ in range(most):
            self.press("Tab", 9)
            seen.append(self.evaluate("called(focused(document))"))
            if seen[-1] == name:
                return
        raise AssertionError(f"Tab does not reach {name!r} but {seen}")

    def enter(self, name):
        """Press Tab until the button or tab with a name has the focus, then Enter."""
        self.tab_to(name)
        self.press("Enter", 13)

    def write(self, text):
        """Press the keys of a text, one after the other."""
        for letter in text:
            key = {"key": letter, "text": letter}
            key |= {"windowsVirtualKeyCode": ord(letter.upper())} if letter.isalnum() else {}  # 46 is Delete
            self.send("Input.dispatchKeyEvent", type="keyDown", **key)
            self.send("Input.dispatchKeyEvent", type="keyUp", key=letter)

    def upload(self, path):
        """Choose a file in the field of files of the page."""
        found = self.send(
            "Runtime.evaluate",
            expression=f"(() => {{ {SCRIPT} return all(document).find((e) => e.type === 'file'); }})()",
        )
        self.send("DOM.enable")
        self.send("DOM.setFileInputFiles", files=[str(path)], objectId=found["result"]["objectId"])

    def read_aloud(self):
        """Return role, name and properties of each element, as a program that reads the page aloud gets them."""
        self.send("Accessibility.enable")
        found = []
        for node in self.send("Accessibility.getFullAXTree")["nodes"]:
            if not node.get("ignored"):
                own = {one["name"]: one["value"].get("value") for one in node.get("properties", ())}
                found.append((node["role"]["value"], node.get("name", {}).get("value", ""), own))
        return found

    def picture(self, path, whole=False):
        """Write a picture of the page as PNG: what the window shows, or the whole length of the page."""
        more = {}
        if whole:
            size = self.send("Page.getLayoutMetrics")["cssContentSize"]
            more = {"clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}}
        done = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole, **more)
        Path(path).write_bytes(base64.b64decode(done["data"]))
