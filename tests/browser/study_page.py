"""What study.html has to be, a check each. Every one takes a browser, the page's path and its study, and says
what is wrong as texts. Expectations are computed here from study.json, not taken from the page."""
import json
import math
import pathlib
import time
import xml.dom.minidom

from selenium.webdriver.common.keys import Keys

from browser import Pixels

ERRORS = {"error_rms": "RMS", "error_p999": "99.9 %", "error_max": "largest", "flip": "FLIP"}
TIMES = ["light_ratio", "light_ms", "job_ratio", "job_ms"]


def number(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


def median(config, key):
    of = config["times"].get(key)
    return of["median"] if of and number(of["median"]) else None


def choose(browser, selector, value):
    browser.run("const e = document.querySelector(arguments[0]); e.value = arguments[1];"
                "e.dispatchEvent(new Event('change'))", selector, str(value))


def points(browser):
    """Of the plot: {index: [x, y, classes]}, px in it."""
    return {int(p[0]): p[1:] for p in browser.run(
        "return [...document.querySelectorAll('#front-plot .point')].map(p => {"
        "const t = p.transform.baseVal.consolidate().matrix;"
        "return [p.dataset.index, t.e, t.f, p.getAttribute('class').split(' ')]})")}


def axis(browser, name):
    """Ticks as (value, px)."""
    return [(float(t[0]), t[1]) for t in browser.run(
        "return [...document.querySelectorAll('#front-plot .axis-' + arguments[0] + ' .tick')].map(t => {"
        "const m = t.transform.baseVal.consolidate().matrix;"
        "return [t.textContent, arguments[0] === 'x' ? m.e : m.f]})", name)]


def loads(browser, page, study):
    browser.load(page)
    wrong = ["the console says: %s" % c for c in browser.complaints()]
    if not browser.run("return document.querySelectorAll('#findings-list li').length"):
        wrong.append("there are no findings")
    return wrong


def asks_nothing_of_a_network(browser, page, study):
    browser.load(page)
    browser.run("document.querySelectorAll('details').forEach(d => d.open = true)")
    time.sleep(0.2)
    asked = browser.requests()
    others = [a for a in asked if not a.startswith(("data:", "blob:")) and a != page.as_uri()]
    return ["it asks for %s" % a for a in others] + \
        ([] if page.as_uri() in asked else ["the log of requests has not even the page"])


def has_a_point_for_each(browser, page, study):
    browser.load(page)
    wrong = []
    for i, frame in enumerate(study["frames"]):
        choose(browser, "#frame", i)
        for key in TIMES:
            choose(browser, "#time", key)
            have, want = set(points(browser)), set(range(len(frame["configurations"])))
            if have != want:
                wrong.append("%s, %s: %d points, %d configurations"
                             % (frame["name"], key, len(have), len(want)))
    return wrong


def mapping(ticks):
    """Value to px through two ticks: a logarithm where a third says so."""
    (a, p), (b, q) = ticks[0], ticks[-1]
    straight = lambda v: p + (q - p) * (v - a) / (b - a)
    if min(a, b) <= 0 or len(ticks) < 3:
        return straight
    bent = lambda v: p + (q - p) * math.log(v / a) / math.log(b / a)
    value, at = ticks[len(ticks) // 2]
    return min(straight, bent, key=lambda f: abs(f(value) - at))


def puts_points_where_they_belong(browser, page, study):
    browser.load(page)
    wrong = []
    for i, frame in enumerate(study["frames"]):
        choose(browser, "#frame", i)
        for error in ERRORS:
            for key in TIMES:
                choose(browser, "#error", error)
                choose(browser, "#time", key)
                wrong += misplaced(browser, frame, error, key)
    return wrong[:5]


def misplaced(browser, frame, error, key):
    across, ticks = mapping(axis(browser, "x")), axis(browser, "y")
    down = lambda v: ticks[0][1] + (ticks[1][1] - ticks[0][1]) * math.log(v / ticks[0][0]) / \
        math.log(ticks[1][0] / ticks[0][0])
    wrong, have = [], points(browser)
    for index, config in enumerate(frame["configurations"]):
        x, y, _ = have[index]
        at, off = median(config, key), config["values"].get(error)
        if at is not None and abs(x - across(at)) > 0.6:
            wrong.append("%s, %s: x is %.1f, not %.1f" % (config["title"], key, x, across(at)))
        if at is None and x >= min(t[1] for t in axis(browser, "x")):
            wrong.append("%s, %s: no time, but among those" % (config["title"], key))
        if number(off) and off > 0 and abs(y - down(off)) > 0.6:
            wrong.append("%s, %s: y is %.1f, not %.1f" % (config["title"], error, y, down(off)))
        if (not number(off) or off == 0) and y <= max(t[1] for t in ticks):
            wrong.append("%s, %s: no number above 0, but among those" % (config["title"], error))
    return wrong


def front_of(study, frame, error, key):
    """Indices of what none beats."""
    files = [k for k in study["knobs"] if k["of_files"]]
    def competes(c):
        usual = all(c["knobs"].get(k["name"], k["usual"]) == k["usual"] for k in files)
        return median(c, key) is not None and number(c["values"].get(error)) and \
            (usual or key.startswith("job"))
    all_of = [(i, c) for i, c in enumerate(frame["configurations"]) if competes(c)]
    place = lambda c: (median(c, key), c["values"][error])
    def beaten(i, c):
        return any(o["errors_of"] == c["errors_of"] and k != i and place(o)[0] <= place(c)[0] and
                   place(o)[1] <= place(c)[1] and (place(o) != place(c) or k < i) for k, o in all_of)
    return {i for i, c in all_of if not beaten(i, c)}


def marks_the_front(browser, page, study):
    browser.load(page)
    wrong = []
    for i, frame in enumerate(study["frames"]):
        choose(browser, "#frame", i)
        for error in ERRORS:
            for key in TIMES:
                choose(browser, "#error", error)
                choose(browser, "#time", key)
                have = {k for k, p in points(browser).items() if "on-front" in p[2]}
                if have != front_of(study, frame, error, key):
                    wrong.append("%s, %s, %s: another front" % (frame["name"], error, key))
        for key, flag in (("light_ratio", "front_light"), ("job_ratio", "front_job")):
            want = {k for k, c in enumerate(frame["configurations"]) if c["values"][flag] == 1}
            if front_of(study, frame, "error_rms", key) != want:
                wrong.append("%s: the study's own %s differs" % (frame["name"], flag))
    return wrong


def is_unstable(config, key):
    return config.get("unstable") is True or (config["times"].get(key) or {}).get("unstable") is True


def marks_what_is_unstable(browser, page, study):
    browser.load(page)
    have = {k for k, p in points(browser).items() if "unstable" in p[2]}
    signs = browser.run("return [...document.querySelectorAll('.point .unstable-sign')]"
                        ".map(s => +s.parentNode.dataset.index)")
    want = {i for i, c in enumerate(study["frames"][0]["configurations"]) if is_unstable(c, "light_ratio")}
    return [] if have == want == set(signs) else ["marked are %s, not %s" % (sorted(have), sorted(want))]


def tab_to(browser, selector):
    """Whether the Tab key gets there."""
    browser.run("document.activeElement.blur(); scrollTo(0, 0)")
    for _ in range(60):
        browser.press(Keys.TAB)
        if browser.run("return document.activeElement.matches(arguments[0])", selector):
            return True
    return False


def is_reached_by_keys(browser, page, study):
    """Every configuration, by Tab and arrow keys, with its figures and a ring that is seen."""
    browser.load(page)
    configs, wrong = study["frames"][0]["configurations"], []
    if not tab_to(browser, ".point"):
        return ["Tab does not get to the plot"]
    for first, step in ((Keys.HOME, Keys.ARROW_RIGHT), (Keys.END, Keys.ARROW_UP)):
        browser.press(first)
        if step == Keys.ARROW_UP:
            browser.press(*[Keys.ARROW_DOWN] * len(configs))
        seen = set()
        for _ in configs:
            wrong += look_at_details(browser, configs, seen)
            browser.press(step)
        if len(seen) != len(configs):
            wrong.append("arrow keys reach %d of %d" % (len(seen), len(configs)))
    return wrong[:5]


def look_at_details(browser, configs, seen):
    index, title, text, says, ring, at = browser.run(
        "const p = document.activeElement, d = document.querySelector('#details');"
        "const ring = document.querySelector('.ring.selected'), b = p.querySelector('.mark')"
        ".getBoundingClientRect(), r = ring.getBoundingClientRect();"
        "return [+p.dataset.index, d.querySelector('h3').textContent, d.textContent,"
        "p.getAttribute('role') + ' ' + p.getAttribute('aria-selected') + ' ' + p.getAttribute('aria-label'),"
        "[r.x + r.width / 2, r.y + r.height / 2, parseFloat(getComputedStyle(ring).strokeWidth)],"
        "[b.x + b.width / 2, b.y + b.height / 2]]")
    config = configs[index]
    seen.add(index)
    rms = "%.1e" % config["values"]["error_rms"]
    rms = "0" if config["values"]["error_rms"] == 0 else rms.replace("e-0", "e-")
    wrong = []
    if title != config["title"] or rms not in text:
        wrong.append("%s: details of %s, without %s" % (config["title"], title, rms))
    if not says.startswith("option true " + config["title"]):
        wrong.append("%s: read out as %s" % (config["title"], says))
    if abs(ring[0] - at[0]) > 3 or abs(ring[1] - at[1]) > 4 or ring[2] < 3:
        wrong.append("%s: no ring around it" % config["title"])
    return wrong


def is_reached_by_pointer(browser, page, study):
    """A click at a whole px, which is what clicks tell, beside a point selects what is nearest there."""
    browser.load(page, height=1200)
    left, top, _, _ = browser.box("#front-plot")
    places, wrong = points(browser), []
    for index, (x, y, _) in places.items():
        click = round(left + x), round(top + y)
        away = {i: math.hypot(left + p[0] - click[0], top + p[1] - click[1]) for i, p in places.items()}
        browser.drag(click, click)
        at = browser.run("return +document.querySelector('.point[aria-selected=true]').dataset.index")
        if away[at] > min(away.values()) + 0.01:
            wrong.append("a click on %d selects %d, %.1f px away" % (index, at, away[at]))
    return wrong[:5]


def differs(a, b, most):
    return max(abs(p - q) for p, q in zip(a, b)) > most


def stage_at(browser, percent):
    """The stage with the line there, by keys of the slider alone."""
    browser.run("document.querySelector('#slider').focus()")
    browser.press(Keys.HOME, *[Keys.ARROW_RIGHT] * percent)
    return browser.picture("#stage")


def moves_the_line(browser, page, study):
    """Left of the line is the picture, right of it the map, wherever keys or pointer put it."""
    browser.load(page)
    # At whole px, and each pixel of the map as 2 x 2: else it is chance which one is seen at a place.
    browser.run("const map = document.querySelector('#map'), stage = document.querySelector('#stage');"
                "document.querySelector('#worst').style.display = 'none';"
                "stage.style.cssText += 'position: fixed; left: 0; top: 0; z-index: 9;' +"
                "'width: ' + (2 * map.naturalWidth + 2) + 'px; height: ' + (2 * map.naturalHeight + 2) + 'px'")
    wrong = [] if tab_to(browser, "#slider") else ["Tab does not get to the slider"]
    errors, picture = stage_at(browser, 0), stage_at(browser, 100)
    wrong += look_at_map(browser, errors, page.parent, study)
    for percent, stage in ((30, stage_at(browser, 30)), (70, dragged(browser, 70))):
        line, y = percent * stage.width / 100, stage.height // 2
        for x in range(8, stage.width - 8, 7):
            if abs(x - line) > 6 and differs(stage.at(x, y), (picture if x < line else errors).at(x, y), 3):
                wrong.append("the line at %d %%: another pixel at %d of %d" % (percent, x, stage.width))
    if not any(differs(picture.at(x, picture.height // 2), errors.at(x, picture.height // 2), 16)
               for x in range(8, picture.width - 8, 7)):
        wrong.append("picture and map are the same")
    return wrong[:5]


def dragged(browser, percent):
    x, y, width, height = browser.box("#stage")
    browser.drag((x + width / 2, y + height / 2), (x + width * percent / 100, y + height / 2))
    return browser.picture("#stage")


def look_at_map(browser, stage, folder, study):
    """Its pixels are the file's; 1 px of the stage is its border."""
    index = int(browser.run("return document.querySelector('#map-of').value"))
    file = Pixels((folder / study["frames"][0]["configurations"][index]["map"]).read_bytes())
    places = [(x, y) for x in range(4, file.width, 9) for y in range(4, file.height, 9)]
    wrong = [p for p in places if differs(file.at(*p), stage.at(1 + 2 * p[0], 1 + 2 * p[1]), 2)]
    return ["%d of %d pixels of the map are others" % (len(wrong), len(places))] if wrong else []


def sorts(browser, page, study):
    browser.load(page)
    wrong = []
    configs = study["frames"][0]["configurations"]
    for column, key in (("RMS", "error_rms"), ("largest", "error_max"), ("stored, B/px", "bytes_stored")):
        for want in ("ascending", "descending"):
            browser.run("const b = [...document.querySelectorAll('#all-table thead button')]"
                        ".find(b => b.textContent === arguments[0]); b.focus()", column)
            browser.press(Keys.ENTER)
            order, state = browser.run(
                "return [[...document.querySelectorAll('#all-table tbody tr')].map(r => +r.dataset.index),"
                "document.activeElement.closest('th').getAttribute('aria-sort')]")
            values = [configs[i]["values"][key] for i in order]
            if state != want or sorted(order) != list(range(len(configs))) or \
                    values != sorted(values, reverse=want == "descending"):
                wrong.append("%s, %s: aria-sort is %s, values are %s" % (column, want, state, values[:4]))
    return wrong


def shows_claims(browser, page, study):
    browser.load(page)
    claims = study.get("claims", [])
    figures = [f for c in claims for f in c["figures"]]
    shown, text, rows, heads = browser.run(
        "const all = document.querySelector('#claims'); return [all.checkVisibility(), all.innerText,"
        "[...document.querySelectorAll('#claims-table tbody tr')].map(r => r.textContent),"
        "document.querySelectorAll('#claims-table th[aria-sort]').length]")
    if shown != bool(figures) or len(rows) != len(figures) or heads != 1:
        return ["%d rows shown, %d figures" % (len(rows), len(figures))]
    said = [c[key] for c in claims for key in ("name", "claim", "source", "method") if c.get(key)]
    wrong = ["\"%s\" is not said" % s for s in said if s not in text]
    for figure in figures:
        numbers = ["%.3g" % v for v in (figure.get("theirs") or []) + [figure["ours"]]
                   if v is not None and abs(v) >= 1e-3]
        row = [r for r in rows if figure["what"] in r]
        wrong += ["%s: no %s" % (figure["what"], n) for n in numbers
                  if not any("%g" % float(n) in r for r in row)]
    return wrong[:5]


VISIBLE_TEXTS = """
const found = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
const solid = color => { const n = color.match(/[0-9.]+/g).map(Number); return n.length < 4 || n[3] > 0; };
while (walker.nextNode()) {
    const e = walker.currentNode.parentElement, style = getComputedStyle(e);
    if (!walker.currentNode.textContent.trim() || e.closest('script, style, option, .skip') ||
        !e.checkVisibility())
        continue;
    const isPlot = e.closest('svg') !== null;
    let under = e;
    while (under && !isPlot && !solid(getComputedStyle(under).backgroundColor)) under = under.parentElement;
    found.push({ text: walker.currentNode.textContent.trim().slice(0, 40), size: parseFloat(style.fontSize),
                 bold: +style.fontWeight >= 600, color: isPlot ? style.fill : style.color,
                 under: isPlot ? getComputedStyle(e.closest('svg').querySelector('.paper')).fill
                               : under ? getComputedStyle(under).backgroundColor : 'rgb(255, 255, 255)' });
}
return found;"""


def luminance(color):
    """WCAG 2.2's relative luminance of "rgb(r, g, b)"."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
              for c in (float(n) / 255 for n in color[color.index("(") + 1:-1].split(",")[:3])]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def has_contrast(browser, page, study):
    """WCAG 2.2, 1.4.3, level AA, in both schemes, which differ."""
    wrong, grounds = [], []
    for scheme in ("light", "dark"):
        browser.load(page, features={"prefers-color-scheme": scheme})
        browser.run("document.querySelectorAll('details').forEach(d => d.open = true)")
        texts = browser.run(VISIBLE_TEXTS)
        grounds.append(luminance(browser.run("return getComputedStyle(document.body).backgroundColor")))
        for t in texts:
            is_large = t["size"] >= 24 or (t["size"] >= 18.66 and t["bold"])
            if contrast(t["color"], t["under"]) < (3 if is_large else 4.5):
                wrong.append("%s: \"%s\" has %.1f" % (scheme, t["text"], contrast(t["color"], t["under"])))
    if not grounds[0] > 0.8 or not grounds[1] < 0.1:
        wrong.append("light and dark are no schemes of their own")
    return wrong[:5]


def fits_a_telephone(browser, page, study):
    """400 px wide: nothing stands out of the window, no text is below 12 px, plots are not shrunk."""
    browser.load(page, width=400)
    browser.run("document.querySelectorAll('details').forEach(d => d.open = true)")
    wide = browser.run("return [document.documentElement.scrollWidth, document.body.scrollWidth, innerWidth]")
    wrong = ["the body is %d px wide" % max(wide[:2])] if max(wide) > 400 else []
    texts = browser.run(VISIBLE_TEXTS)
    wrong += ["\"%s\" is %.1f px" % (t["text"], t["size"]) for t in texts if t["size"] < 12]
    scale = browser.run("const s = document.querySelector('#front-plot');"
                        "return s.getBoundingClientRect().width / s.viewBox.baseVal.width")
    if abs(scale - 1) > 0.01:
        wrong.append("the plot is drawn at %.2f of its size" % scale)
    return wrong[:5]


CROWDED_TEXTS = """
const found = [];
for (const svg of document.querySelectorAll('.plot')) {
    const s = svg.getBoundingClientRect(), texts = [...svg.querySelectorAll('text:not(.unstable-sign)')]
        .map(t => ({ text: t.textContent, box: t.getBoundingClientRect() }));
    texts.filter(t => t.box.left < s.left - 1 || t.box.right > s.right + 1 || t.box.bottom > s.bottom + 1)
        .forEach(t => found.push('cuts "' + t.text + '"'));
    texts.forEach((a, i) => texts.slice(i + 1).filter(b => a.box.left < b.box.right - 1 &&
        b.box.left < a.box.right - 1 && a.box.top < b.box.bottom - 4 && b.box.top < a.box.bottom - 4)
        .forEach(b => found.push('has "' + a.text + '" over "' + b.text + '"')));
}
return found;"""


def keeps_texts_apart(browser, page, study):
    """In plots no text is cut, and none stands on another; 4 px of a line's height are air."""
    wrong = []
    for width in (1280, 820, 400):
        browser.load(page, width=width)
        choose(browser, "#rows", "all")
        for key in TIMES:
            choose(browser, "#time", key)
            wrong += ["%d px, %s: a plot %s" % (width, key, what) for what in browser.run(CROWDED_TEXTS)]
    return wrong[:5]


def keeps_still(browser, page, study):
    browser.load(page)
    moving = browser.run(
        "return [...document.querySelectorAll('*')].filter(e => { const s = getComputedStyle(e);"
        "return s.scrollBehavior === 'smooth' || parseFloat(s.transitionDuration) > 0 ||"
        "parseFloat(s.animationDuration) > 0 }).map(e => e.tagName)")
    return ["%s moves" % m for m in moving][:5]


def saves_plots(browser, page, study):
    """Each button leaves an SVG file that has what the page shows, and its colours."""
    browser.load(page)
    frame, wrong = study["frames"][0], []
    for plot, parts, count in (("front", "point", len(frame["configurations"])), ("causes", "bar", None)):
        file = pathlib.Path(browser.downloads) / ("%s-%s.svg" % (frame["name"], plot))
        file.unlink(missing_ok=True)
        browser.box("button[data-plot=%s-plot]" % plot)
        browser.run("document.querySelector(arguments[0]).click()", "button[data-plot=%s-plot]" % plot)
        for _ in range(50):
            if file.exists() and file.stat().st_size:
                break
            time.sleep(0.1)
        else:
            wrong.append("%s: no file is saved" % plot)
            continue
        wrong += look_at_file(browser, file, plot, parts, count)
    return wrong


def classes(element):
    return element.getAttribute("class").split()


def look_at_file(browser, file, plot, parts, count):
    text = file.read_text()
    nodes = xml.dom.minidom.parseString(text).getElementsByTagName("*")
    have = [n for n in nodes if parts in classes(n)]
    shown = browser.run("return document.querySelectorAll('#%s-plot .%s').length" % (plot, parts))
    wrong = []
    if len(have) != (count if count is not None else shown) or len(have) != shown:
        wrong.append("%s: %d of %d are in the file" % (file.name, len(have), shown))
    if "prefers-color-scheme: dark" not in text or any("passing" in classes(n) for n in nodes):
        wrong.append("%s: without a style, or with what passes" % file.name)
    return wrong


def has_its_plots_as_files(browser, page, study):
    """What scripts/study-svg wrote beside the page is what the page shows."""
    browser.load(page)
    wrong = []
    for plot, parts in (("front", "point"), ("causes", "bar")):
        file = page.with_name(plot + ".svg")
        wrong += look_at_file(browser, file, plot, parts, None) if file.exists() else ["no %s" % file.name]
    return wrong


def tells_findings(browser, page, study):
    """The sentences' figures are those of the data."""
    browser.load(page)
    said = browser.run("return document.querySelector('#findings-list').innerText")
    configs, wrong = study["frames"][0]["configurations"], []
    front = front_of(study, study["frames"][0], "error_rms", "light_ratio")
    for limit in (1e-6, 1e-4, 1e-2):
        fit = [c for i, c in enumerate(configs) if i in front and c["values"]["error_rms"] <= limit]
        best = min(fit, key=lambda c: median(c, "light_ratio")) if fit else None
        text = "%g" % limit if limit > 1e-4 else "%.0e" % limit
        line = next((s for s in said.split("\n") if "1e-%d" % round(-math.log10(limit)) in s
                     and s.startswith("Within")), "")
        usual = best and all(best["knobs"][k["name"]] == k["usual"] for k in study["knobs"])
        want = "nothing" if not best else "default" if usual else "%.2f of" % median(best, "light_ratio")
        if want not in line:
            wrong.append("within %s: \"%s\" has no %s" % (text, line, want))
    changed = sum(1 for c in configs if (c["values"].get("culling_differing") or 0) > 0)
    if ("changes no bit" in said) != (changed == 0):
        wrong.append("%d pictures are changed by culling, and it says: %s" % (changed, said))
    causes = [c["main_cause"] for c in configs]
    most = max(set(causes) - {"none"}, key=causes.count)
    if "%s is the largest part of the error in %d of" % (most.capitalize(), causes.count(most)) not in said:
        wrong.append("%s in %d is not said" % (most, causes.count(most)))
    return wrong


CHECKS = [loads, asks_nothing_of_a_network, has_a_point_for_each, puts_points_where_they_belong,
          marks_the_front, marks_what_is_unstable, is_reached_by_keys, is_reached_by_pointer, moves_the_line,
          sorts, shows_claims, has_contrast, fits_a_telephone, keeps_texts_apart, keeps_still, saves_plots,
          has_its_plots_as_files, tells_findings]


def read(page):
    return json.loads((page.parent / "study.json").read_text())
