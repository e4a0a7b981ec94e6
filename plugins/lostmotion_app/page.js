// Keys for the screens, and names and roles for programs that read the page aloud, which Bokeh and Panel leave out.
const asked = new URLSearchParams(location.search);
if (!asked.has("theme") && matchMedia("(prefers-color-scheme: dark)").matches) {
  asked.set("theme", "dark");
  location.replace(location.pathname + "?" + asked);
}

document.addEventListener("keydown", (event) => {
  const [tab] = event.composedPath();
  if (!tab.classList?.contains("bk-tab")) return;
  const tabs = [...tab.parentNode.children], at = tabs.indexOf(tab);
  const next = {
    ArrowRight: tabs[at + 1], ArrowLeft: tabs[at - 1], Home: tabs[0], End: tabs.at(-1), Enter: tab, " ": tab,
  }[event.key];
  if (!next) return;
  event.preventDefault();
  next.focus();
  next.click();
});

const DESCRIBED = ".bk-header, .noUi-handle, .choices, .choices__input--cloned, .bk-btn-group > .bk-btn:not(:only-child)";
const watched = new WeakSet();

function set(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (element.getAttribute(key) !== value) element.setAttribute(key, value);
  }
}

function describeTabs(head) {
  const [list] = head.children, panels = [...head.parentNode.children].filter((e) => e.shadowRoot);
  if (head !== head.parentNode.firstElementChild) head.parentNode.prepend(head);  // as the eye, the Tab key comes first to it
  set(list, {role: "tablist", "aria-label": "Screens"});
  [...list.children].forEach((tab, number) => {
    set(tab, {role: "tab", "aria-selected": String(tab.classList.contains("bk-active"))});
    if (panels[number]) set(panels[number], {role: "tabpanel", "aria-label": tab.textContent});
  });
}

function describeHandle(handle) {  // the title of a slider is "name: value"; that of a list of values stands before it
  const box = handle.getRootNode(), before = box.host.previousElementSibling?.shadowRoot;
  const said = box.querySelector(".bk-slider-title")?.textContent || before?.querySelector(".bk-clearfix")?.textContent;
  if (!said?.includes(": ")) return;
  const cut = said.lastIndexOf(": "), [name, value] = [said.slice(0, cut), said.slice(cut + 2)];
  const handles = box.querySelectorAll(".noUi-handle");
  const own = handle.querySelector(".noUi-tooltip")?.textContent || value;
  const end = handles.length > 1 ? (handle === handles[0] ? ", begin" : ", end") : "";
  set(handle, {"aria-label": name + end, ...(own ? {"aria-valuetext": own} : {})});
  if (watched.has(handle)) return;
  watched.add(handle);
  new MutationObserver(() => describeHandle(handle)).observe(handle, {attributeFilter: ["aria-valuetext"]});
}

function describe(root) {
  for (const one of root.querySelectorAll(DESCRIBED)) {
    if (one.matches(".bk-header")) describeTabs(one);
    else if (one.matches(".noUi-handle")) describeHandle(one);
    else if (one.matches(".bk-btn")) set(one, {"aria-pressed": String(one.classList.contains("bk-active"))});
    else set(one, {"aria-label": root.querySelector("label")?.textContent ?? ""});
  }
  for (const one of root.querySelectorAll("div")) {  // all widgets of Bokeh are such
    if (one.shadowRoot) describe(one.shadowRoot);
  }
}

setInterval(() => describe(document), 400);
