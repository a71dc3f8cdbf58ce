"""Headless Chromium for tests of a page that needs no network: what it shows, says and asks for."""

import base64
import io
import json
from pathlib import Path

from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.service import Service

OPTIONS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
           "--force-color-profile=srgb", "--force-device-scale-factor=1", "--disable-background-networking", "--no-first-run"]

# Text below WCAG 2.1's contrast of 4.5 : 1, or 3 : 1 where it is large, as "text (ratio)". Text over pictures is left out.
LOW_CONTRAST = """
const channel = (v) => { v /= 255; return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; };
const parse = (css) => css.match(/[\\d.]+/g).map(Number);
const luminance = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
const backdrop = (element) => {
  for (let e = element; e; e = e.parentElement) {
    const color = parse(getComputedStyle(e).backgroundColor);
    if (color.length < 4 || color[3] === 1) return color;
  }
  return [255, 255, 255];
};
const low = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const text = walker.currentNode.textContent.trim(), element = walker.currentNode.parentElement;
  if (!text || !element.checkVisibility() || element.closest("script, .visually-hidden, :disabled, :disabled + span")) continue;
  const style = getComputedStyle(element);
  const [x, y] = [luminance(parse(style.color)), luminance(backdrop(element))];
  const ratio = (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
  const size = parseFloat(style.fontSize);
  if (ratio < (size >= 24 || (size >= 18.66 && style.fontWeight >= 700) ? 3 : 4.5)) low.push(`${text} (${ratio.toFixed(2)})`);
}
return low;
"""


class Browser:
    def __init__(self) -> None:
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for option in OPTIONS:
            options.add_argument(option)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)

    def quit(self) -> None:
        self.driver.quit()

    def call(self, command: str, **parameters: object) -> dict:
        return self.driver.execute_cdp_cmd(command, parameters)

    def open(self, page: Path, width: int = 1400, height: int = 1000, scripts: bool = True, **features: str) -> None:
        """Opens the page anew. `features`: media features such as prefers_color_scheme="dark"."""
        self.call("Emulation.setScriptExecutionDisabled", value=not scripts)
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", media="",
                  features=[{"name": name.replace("_", "-"), "value": value} for name, value in features.items()])
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(page.as_uri())

    def run(self, script: str, *arguments: object) -> object:
        return self.driver.execute_script(script, *arguments)

    def complaints(self) -> list[str]:
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self) -> list[str]:
        """Addresses asked for since the page was opened, but for those of data that the page holds itself."""
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if not url.startswith("data:")]

    def accessible(self) -> list[tuple[str, str]]:
        """Role and name of everything that assistive technology is told of."""
        nodes = self.call("Accessibility.getFullAXTree")["nodes"]
        return [(node["role"]["value"], node.get("name", {}).get("value", "").strip()) for node in nodes
                if not node.get("ignored") and "role" in node]

    def picture_of(self, element: object) -> Image.Image:
        """What the element looks like, pixel by pixel, whether on screen or not."""
        box = self.run("""const box = arguments[0].getBoundingClientRect();
                          return [box.x + scrollX, box.y + scrollY, box.width, box.height];""", element)
        shot = self.call("Page.captureScreenshot", captureBeyondViewport=True,
                         clip=dict(zip(("x", "y", "width", "height"), box), scale=1))
        return Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")
