"""Chromium without a screen, as a test needs it: pages, keys, what is shown, and what went wrong."""
import base64
import contextlib
import json
import zlib

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-dev-shm-usage",
         "--force-color-profile=srgb"]


class Browser:
    """downloads: the folder that files are saved in."""

    def __init__(self, downloads):
        options = Options()
        for flag in FLAGS:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.downloads = downloads
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))

    def cdp(self, command, **arguments):
        return self.driver.execute_cdp_cmd(command, arguments)

    def load(self, path, width=1280, height=900, features=None):
        """Loads a file in a window of that size. features: of CSS media queries, name to value. Nothing
        glides unless they say so: places that were asked for are still the places a moment later."""
        features = {"prefers-reduced-motion": "reduce", **(features or {})}
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                 mobile=width < 600)
        self.cdp("Emulation.setEmulatedMedia",
                 features=[{"name": n, "value": v} for n, v in features.items()])
        for log in ("browser", "performance"):
            self.driver.get_log(log)  # what pages before left
        self.driver.get("file://%s" % path)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def complaints(self):
        """What the console has of the page, as texts."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """Addresses that were asked for."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]

    def press(self, *keys):
        chain = ActionChains(self.driver, duration=0)
        for key in keys:
            chain.send_keys(key)
        chain.perform()

    def box(self, selector):
        """[x, y, width, height] of an element that is scrolled to, in px of the window."""
        return self.run("const e = document.querySelector(arguments[0]);"
                        "e.scrollIntoView({block: 'center', behavior: 'instant'});"
                        "const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]", selector)

    def drag(self, start, end):
        """By the left button, from one place in the window to another."""
        for kind, place in (("mousePressed", start), ("mouseMoved", end), ("mouseReleased", end)):
            self.cdp("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left",
                     buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def picture(self, selector):
        """What an element shows, as Pixels."""
        x, y, width, height = self.box(selector)
        shot = self.cdp("Page.captureScreenshot", format="png", captureBeyondViewport=False,
                        clip={"x": x + self.run("return scrollX"), "y": y + self.run("return scrollY"),
                              "width": width, "height": height, "scale": 1})
        return Pixels(base64.b64decode(shot["data"]))

    def close(self):
        self.driver.quit()


class Pixels:
    """A PNG file of 8 bits, with or without alpha: [y][x] is (red, green, blue)."""

    def __init__(self, data):
        chunks, at = {}, 8
        while at < len(data):
            size, name = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
            chunks[name] = chunks.get(name, b"") + data[at + 8:at + 8 + size]
            at += size + 12
        head = chunks[b"IHDR"]
        self.width, self.height = (int.from_bytes(head[i:i + 4], "big") for i in (0, 4))
        assert head[8] == 8 and head[9] in (2, 6) and head[12] == 0, "a kind of PNG that is not read here"
        self.step = 3 if head[9] == 2 else 4
        self.rows = self._unfilter(zlib.decompress(chunks[b"IDAT"]))

    def _unfilter(self, raw):
        """W3C PNG specification, 9.2."""
        size, step, rows, above = self.width * self.step, self.step, [], bytes(self.width * self.step)
        for y in range(self.height):
            kind, row = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
            for i in range(size):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                row[i] = (row[i] + predict(kind, left, above[i], corner)) & 255
            rows.append(bytes(row))
            above = rows[-1]
        return rows

    def at(self, x, y):
        start = x * self.step
        return tuple(self.rows[y][start:start + 3])


def predict(kind, left, up, corner):
    if kind == 4:
        near = left + up - corner
        return min((left, up, corner), key=lambda v: abs(near - v))
    return (0, left, up, (left + up) // 2)[kind]


@contextlib.contextmanager
def browser(downloads):
    one = Browser(downloads)
    try:
        yield one
    finally:
        one.close()
