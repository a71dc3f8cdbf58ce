// The page reads without this script; it adds sorting, the choice of columns and rows, and the comparison of pictures.
"use strict";

const say = (text) => { document.getElementById("said").textContent = text; };

// ---- Tables ----

const valueOf = (cell) => cell.dataset.v ?? cell.textContent.trim();

// Sorts by column `index`: 1 up, -1 down, 0 as the table came. Empty cells stay last; equal ones keep the table's order.
function sortRows(rows, index, numeric, direction) {
  const sign = direction || 1;
  const order = rows.map((row, at) => ({ row, at, value: valueOf(row.cells[index]) }));
  if (direction !== 0) {
    const collator = new Intl.Collator("en", { numeric: true });
    order.sort((x, y) => {
      if (!x.value || !y.value) return !x.value - !y.value || x.at - y.at;
      const difference = numeric ? Number(x.value) - Number(y.value) : collator.compare(x.value, y.value);
      return sign * difference || x.at - y.at;
    });
  }
  return order.map((entry) => entry.row);
}

function makeSortable(table) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0], original = [...body.rows];
  heads.forEach((head, index) => {
    head.querySelector("button").addEventListener("click", () => {
      const before = head.getAttribute("aria-sort");
      const direction = before === "ascending" ? -1 : before === "descending" ? 0 : 1;
      for (const other of heads) other.removeAttribute("aria-sort");
      if (direction) head.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
      body.append(...sortRows(original, index, head.classList.contains("number"), direction));
      const name = head.textContent.replace(/[↑↓]/g, "").trim();
      say(direction ? `Sorted by ${name}, ${head.getAttribute("aria-sort")}` : "In the table's own order");
    });
  });
}

function makeRowTools(block) {
  const table = block.querySelector("table"), rows = [...table.tBodies[0].rows];
  const heads = [...table.tHead.rows[0].cells];
  const showColumns = (set) => {
    const hidden = heads.map((head) => set !== "all" && !head.dataset.sets.split(" ").includes(set));
    for (const row of [table.tHead.rows[0], ...rows]) [...row.cells].forEach((cell, i) => { cell.hidden = hidden[i]; });
  };
  const radios = [...block.querySelectorAll("input[type=radio]")];
  for (const radio of radios) {
    radio.disabled = radio.value !== "all" && !heads.some((h) => h.dataset.sets === radio.value || h.dataset.sets.startsWith(radio.value + " ")
      || (h.dataset.sets.endsWith(" " + radio.value) && h.dataset.sets !== "main metric time"));
    radio.addEventListener("change", () => showColumns(radio.value));
  }
  const first = radios.find((radio) => !radio.disabled);
  first.checked = true;
  showColumns(first.value);

  const search = block.querySelector("input[type=search]"), count = block.querySelector(".count");
  search.addEventListener("input", () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = [...row.cells].map((cell) => cell.textContent).join(" ").toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      shown += !row.hidden;
    }
    count.textContent = words.length ? `${shown} of ${rows.length} rows` : "";
  });
  block.querySelector(".tools").hidden = false;
}

// ---- Comparison of two pictures ----

function fillPictures(select, view, chosen) {
  select.replaceChildren();
  const groups = new Map();
  for (const label of view.querySelectorAll("figcaption [data-kind]")) {
    const { kind, point } = label.dataset;
    if (!groups.has(point)) {
      const group = point ? document.createElement("optgroup") : select;
      if (point) { group.label = point; select.append(group); }
      groups.set(point, group);
    }
    const key = label.closest("figure").querySelector("img").id;
    groups.get(point).append(new Option(kind, key, false, false));
  }
  select.value = chosen;
}

function makeComparer(block) {
  const comparer = block.querySelector(".comparer"), pane = block.querySelector(".pane"), stage = block.querySelector(".stage");
  const find = (selector) => comparer.querySelector(selector);
  const views = [...block.querySelectorAll("[data-view]")].filter((view) => view.querySelectorAll("img").length > 1);
  if (!views.length) return;
  const choice = { view: find("select.view"), a: find("select.a"), b: find("select.b") };
  const at = find(".at"), gain = find(".gain"), flip = find(".flip"), zoom = find(".zoom");
  const labelOf = (select) => {
    const option = select.selectedOptions[0];
    return option.text + (option.parentElement.label ? ` (${option.parentElement.label})` : "");
  };

  const showPictures = () => {
    for (const side of ["a", "b"]) {
      const source = document.getElementById(choice[side].value), shown = pane.querySelector("img." + side);
      shown.src = source.src;
      shown.alt = `${side.toUpperCase()}: ${labelOf(choice[side])}`;
      shown.width = source.width;
      shown.height = source.height;
      pane.style.setProperty("--ratio", source.getAttribute("width") / source.getAttribute("height"));
      pane.style.setProperty("--width", source.getAttribute("width") + "px");
    }
    find(".shown").textContent = `A: ${labelOf(choice.a)}; B: ${labelOf(choice.b)}`;
    showFlip(false);
  };
  const showView = () => {
    const view = views[choice.view.selectedIndex];
    fillPictures(choice.a, view, view.dataset.a);
    fillPictures(choice.b, view, view.dataset.b);
    showPictures();
  };
  const showBorder = () => {
    pane.style.setProperty("--at", at.value + "%");
    at.nextElementSibling.textContent = Math.round(at.value) + " %";
  };
  const showGain = () => {
    const factor = 2 ** gain.value;
    pane.style.setProperty("--gain", factor);
    gain.nextElementSibling.textContent = factor === 1 ? "not at all" : factor + " times";
  };
  const showFlip = (b) => {
    pane.dataset.shown = b ? "b" : "a";
    flip.setAttribute("aria-pressed", b);
    flip.nextElementSibling.textContent = `Now ${b ? "B" : "A"}: ${labelOf(choice[b ? "b" : "a"])}`;
  };
  const turn = () => showFlip(pane.dataset.shown !== "b");
  const showMode = (mode) => { comparer.dataset.mode = mode; };

  views.forEach((view) => choice.view.add(new Option(view.dataset.view)));
  choice.view.addEventListener("change", showView);
  choice.a.addEventListener("change", showPictures);
  choice.b.addEventListener("change", showPictures);
  at.addEventListener("input", showBorder);
  gain.addEventListener("input", showGain);
  flip.addEventListener("click", turn);
  zoom.addEventListener("change", () => { stage.dataset.zoom = zoom.value; pane.style.setProperty("--zoom", Number(zoom.value) || 1); });
  for (const radio of comparer.querySelectorAll(".mode input")) {
    radio.addEventListener("change", () => showMode(radio.value));
    if (radio.checked) showMode(radio.value);
  }

  const drag = (event) => {
    const box = pane.getBoundingClientRect();
    at.value = 100 * (event.clientX - box.left) / box.width;
    showBorder();
  };
  pane.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    if (comparer.dataset.mode === "flip") turn();
    if (comparer.dataset.mode !== "slider") return;
    pane.setPointerCapture(event.pointerId);
    drag(event);
  });
  pane.addEventListener("pointermove", (event) => {
    if (pane.hasPointerCapture(event.pointerId)) drag(event);
  });

  stage.dataset.zoom = "fit";
  showView();
  showBorder();
  showGain();
  comparer.hidden = false;
  block.querySelector(".gallery").open = false;
}

document.querySelectorAll("table.sortable").forEach(makeSortable);
document.querySelectorAll(".rows").forEach(makeRowTools);
document.querySelectorAll(".pictures").forEach(makeComparer);

// On paper everything is open.
let opened = [];
addEventListener("beforeprint", () => {
  opened = [...document.querySelectorAll("details:not([open])")];
  for (const details of opened) details.open = true;
});
addEventListener("afterprint", () => { for (const details of opened) details.open = false; });

// A link to something inside a closed part opens it.
const openTarget = () => {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target instanceof HTMLDetailsElement) target.open = true;
};
addEventListener("hashchange", openTarget);
openTarget();
