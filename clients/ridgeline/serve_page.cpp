#include "clients/ridgeline/serve_page.hpp"

namespace ridgeline::command {

std::string_view serve_page() {
  return R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Ridgeline</title>
<link rel="stylesheet" href="/style.css">
<script src="/script.js" defer></script>
</head>
<body>
<h1>Ridgeline</h1>
<section><h2>Service</h2><pre id="status">...</pre></section>
<section><h2>Library</h2><div id="library">...</div></section>
<section><h2>Job</h2>
<form id="hole">
<label>bore radius [mm] <input name="inner_radius" value="20"></label>
<label>outer radius [mm] <input name="outer_radius" value="30"></label>
<label>hole radius [mm] <input name="radius" value="5"></label>
<label>eccentric distance [mm] <input name="eccentric_distance" value="0"></label>
<label>ball radius [mm] <input name="ball" value="3"></label>
<label>neck radius [mm] <input name="neck" value="1.5"></label>
<label>chamfer width [mm] <input name="width" value="0.5"></label>
<button type="submit">Write the job</button>
</form>
<p><label>or a job file <input type="file" id="file" accept=".json,application/json"></label></p>
<textarea id="job" rows="12" spellcheck="false" aria-label="Job (JSON)"></textarea>
<p><label>show as <select id="format"><option>html</option><option>json</option><option>nc</option><option>csv</option>
<option>svg</option></select></label> <button id="run" type="button">Compute</button> <span id="progress"></span></p>
</section>
<section><h2>Result</h2><pre id="text" hidden></pre><iframe id="result" title="Result" hidden></iframe></section>
</body>
</html>
)html";
}

std::string_view serve_script() {
  return R"js("use strict";
const at = (id) => document.getElementById(id);
let underWay = false;

async function showStatus() {
  try {
    const answer = await (await fetch("/api/status")).json();
    const lines = (answer.instances || []).map((i) =>
      `${i.name}  ${i.version}  running ${i.running} of ${i.workers}  queued ${i.queued}  requests ${i.requests}`);
    at("status").textContent = lines.join("\n") || answer.error.message;
    const jobs = (answer.under_way || []).map((j) => `${Math.round(100 * j.fraction)} % ${j.stage}`);
    at("progress").textContent = underWay ? jobs.join(", ") : "";
  } catch (error) {
    at("status").textContent = `no gateway: ${error.message}`;
  }
  setTimeout(showStatus, 1000);
}

async function showLibrary() {
  const answer = await (await fetch("/api/library")).json();
  const list = document.createElement("ul");
  for (const each of answer.definitions || []) {
    const item = document.createElement("li");
    item.textContent = `${each.kind} ${each.name}, revision ${each.revision}`;
    list.append(item);
  }
  at("library").replaceChildren(answer.definitions ? list : answer.error.message);
}

function writeJob(event) {
  event.preventDefault();
  const value = (name) => Number(at("hole").elements[name].value);
  const job = {
    job: "chamfer",
    workpiece: {
      shape: "thick_walled_cylinder", inner_radius: value("inner_radius"), outer_radius: value("outer_radius"),
      length: 10 * value("outer_radius"),
      holes: [{ name: "H1", shape: "circle", radius: value("radius"), eccentric_distance: value("eccentric_distance") }],
    },
    hole: "H1", edge: "inner",
    tool: { number: 1, shape: "lollipop", radius: value("ball"), neck_radius: value("neck"),
      neck_length: 2 * value("outer_radius") },
    width: value("width"),
  };
  at("job").value = JSON.stringify(job, null, 1);
}

function show(text, source) {
  at("text").hidden = source !== "";
  at("text").textContent = text;
  at("result").hidden = source === "";
  if (source !== "") at("result").src = source;
}

async function compute() {
  underWay = true;
  at("run").disabled = true;
  try {
    const answer = await fetch(`/api/job?format=${at("format").value}`,
      { method: "POST", headers: { "Content-Type": "application/json" }, body: at("job").value });
    if (answer.status === 201) show("", (await answer.json()).result);
    else show(await answer.text(), "");
  } catch (error) {
    show(error.message, "");
  }
  at("run").disabled = false;
  underWay = false;
}

at("hole").addEventListener("submit", writeJob);
at("file").addEventListener("change", async () => { at("job").value = await at("file").files[0].text(); });
at("run").addEventListener("click", compute);
showStatus();
showLibrary();
)js";
}

std::string_view serve_style() {
  return R"css(:root { color-scheme: light dark; font: 15px system-ui, sans-serif; }
body { max-width: 1200px; margin: 0 auto; padding: 0 12px; }
form { display: grid; grid-template-columns: repeat(auto-fill, minmax(220px, 1fr)); gap: 8px; }
input { width: 6em; }
input[type=file] { width: auto; }
textarea { width: 100%; box-sizing: border-box; font-family: monospace; }
pre { overflow: auto; }
iframe { width: 100%; height: 90vh; border: 1px solid gray; }
)css";
}

}  // namespace ridgeline::command
