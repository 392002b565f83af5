// The search field of every page, and the field for a message. ENTRIES and FAMILIES come from search-index.js.
"use strict";

const root = document.body.dataset.root;
const field = document.getElementById("search"), list = document.getElementById("results");
const MOST = 30;
let chosen = -1;

// 0 for no match; names count more than sentences, and whole words more than parts. Every word must be somewhere.
function score(entry, words) {
  const name = entry[1].toLowerCase(), bare = name.replace(/[<>="]/g, "");
  const text = (entry[3] + " " + entry[4]).toLowerCase();
  let sum = 0;
  for (const word of words) {
    if (bare === word || name === word) sum += 100;
    else if (bare.startsWith(word)) sum += 40;
    else if (bare.split(/[^a-z0-9]+/).includes(word)) sum += 30;
    else if (bare.includes(word)) sum += 20;
    else if (text.split(/[^a-z0-9_.]+/).includes(word)) sum += 8;
    else if (text.includes(word)) sum += 4;
    else return 0;
  }
  return sum + { page: 6, tutorial: 7, message: 5, tag: 4, scene: 3, "C++": 0 }[entry[0]] - bare.length / 100;
}

// The family whose words cover the most letters of a message, as in tools/python/tushar/manual/messages.py.
function familyOf(message) {
  let best = null, most = 0;
  for (const [id, title, patterns] of FAMILIES) {
    for (const parts of patterns) {
      let at = 0, letters = 0;
      for (const part of parts) {
        at = part ? message.indexOf(part, at) : at;
        if (at < 0) break;
        at += part.length;
        letters += part.length;
      }
      if (at >= 0 && letters > most) [best, most] = [[id, title], letters];
    }
  }
  return best;
}

function find(text) {
  const words = text.toLowerCase().split(/\s+/).map(word => word.replace(/[<>="'`,;:]+/g, "")).filter(Boolean);
  if (!words.length) return [];
  const found = [];
  for (const entry of ENTRIES) {
    const points = score(entry, words);
    if (points > 0) found.push([points, entry]);
  }
  found.sort((a, b) => b[0] - a[0] || (a[1][1] < b[1][1] ? -1 : 1));
  const entries = found.slice(0, MOST).map(pair => pair[1]);
  const family = words.length > 2 && familyOf(text);
  if (family)
    entries.unshift(["message", family.join(" "), "messages.html#" + family[0], "the message that you typed", ""]);
  return entries;
}

function show(entries) {
  list.replaceChildren();
  for (const [kind, title, url, text, where] of entries) {
    const item = document.createElement("li"), anchor = document.createElement("a");
    anchor.href = root + url;
    const mark = document.createElement("small");
    mark.className = "kind";
    mark.textContent = kind;
    anchor.append(mark, title);
    for (const line of [text, where]) {
      if (!line) continue;
      const small = document.createElement("small");
      small.textContent = line.length > 110 ? line.slice(0, 108) + "…" : line;
      anchor.append(small);
    }
    item.append(anchor);
    list.append(item);
  }
  if (!entries.length) list.innerHTML = "<li><a>nothing found</a></li>";
  chosen = -1;
  list.hidden = !field.value.trim();
}

function choose(step) {
  const items = [...list.children];
  if (!items.length) return;
  items.forEach(item => item.classList.remove("chosen"));
  chosen = (chosen + step + items.length) % items.length;
  items[chosen].classList.add("chosen");
  items[chosen].scrollIntoView({ block: "nearest" });
}

field.addEventListener("input", () => show(find(field.value)));
field.addEventListener("focus", () => { if (field.value.trim()) show(find(field.value)); });
field.addEventListener("keydown", event => {
  if (event.key === "ArrowDown") choose(1);
  else if (event.key === "ArrowUp") choose(-1);
  else if (event.key === "Escape") list.hidden = true;
  else if (event.key === "Enter") {
    const link = list.querySelector(".chosen a[href]") || list.querySelector("a[href]");
    if (link) { list.hidden = true; location.href = link.href; }
  } else return;
  event.preventDefault();
});
document.addEventListener("click", event => { if (!event.target.closest(".search")) list.hidden = true; });
list.addEventListener("click", () => { list.hidden = true; });
document.addEventListener("keydown", event => {
  if (event.key === "/" && !/^(input|textarea)$/i.test(event.target.tagName)) { event.preventDefault(); field.focus(); }
});

// A link to a tag within a closed list opens the list.
function open() {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  for (let at = target; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
  if (target) target.scrollIntoView();
}
addEventListener("hashchange", open);
open();

const message = document.getElementById("message"), family = document.getElementById("family");
if (message) message.addEventListener("input", () => {
  const found = familyOf(message.value);
  family.hidden = !message.value.trim();
  family.replaceChildren();
  if (!found) { family.textContent = "no family has these words"; return; }
  const anchor = document.createElement("a");
  anchor.href = "#" + found[0];
  anchor.textContent = found.join(" ");
  family.append(anchor);
});
// A search in the address, as in index.html?q=cfl
const asked = new URLSearchParams(location.search).get("q");
if (asked) { field.value = asked; show(find(asked)); }
