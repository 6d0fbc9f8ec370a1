// What was found: verdict, figures, audit.

const VIOLATIONS_ON_TOP = 5;

function setUpFindings() {
  const { audit } = DATA;
  const isFine = audit.verdict === "ok";
  byId("title").textContent = `${RUN.scenario} · ${RUN.method}`;
  byId("subtitle").textContent = [
    `${AGENTS.length} agents`, `${told(RUN.end_s)} s simulated`,
    `R = ${told(RUN.range_m, 2)} m, T_c = ${told(RUN.period_s)} s, D_c = ${told(RUN.duration_s)} s`,
    ...(RUN.solver === null ? [] : [`solver ${RUN.solver}`]),
    ...(RUN.seed === null ? [] : [`seed ${RUN.seed}`]),
  ].join(" · ");
  byId("verdict").textContent = `verdict: ${isFine ? "ok" : "FAILED"}`;
  byId("verdict").classList.toggle("ok", isFine);
  if (!isFine) showViolations(audit.verdict);
  byId("figures").append(...keyFigures().map(figureTile));
  showAudit(audit);
}

function showViolations(lines) {
  const list = byId("violations");
  const shown = lines.slice(0, VIOLATIONS_ON_TOP).map((line) => element("li", {}, line));
  const rest = lines.length - shown.length;
  list.append(...shown, ...(rest > 0 ? [element("li", {}, `and ${rest} more, below`)] : []));
  list.hidden = false;
}

/** [what, value, unit] of what is available. */
function keyFigures() {
  const team = DATA.metrics.team;
  const windows = DATA.audit.windows;
  const kept = windows.filter((own) => own.satisfied).length;
  const figures = [
    ["windows kept", `${kept} of ${windows.length}`, ""],
    ["tasks satisfied", told(team.tasks_satisfied, 0), ""],
    ["additional time per agent and meeting", team.additional_s, "s"],
    ["of it detour", team.detour_s, "s"],
    ["of it waiting", team.wait_s, "s"],
    ["lost of each window", team.lost_per_window_s, "s"],
    ["longest makespan", team.makespan_max_s, "s"],
    ["oldest information", team.information_age_max_s, "s"],
    ["largest settled deviation", told(team.deviation_settled_max, 3), ""],
    ["driven", team.distance_m, "m"],
    ["messages", told(team.messages, 0), ""],
  ];
  return figures.filter(([, value]) => value !== null && value !== "–");
}

function figureTile([what, value, unit]) {
  const shown = element("dd", {}, told(value), element("small", {}, unit && ` ${unit}`));
  return element("div", {}, element("dt", {}, what), shown);
}

function showAudit(audit) {
  const parts = [taskTable(audit), promiseTable(audit)];
  if (audit.note) parts.unshift(element("p", {}, `The bag was read only in part: ${audit.note}`));
  const { equal, rounds } = audit.strategies;
  parts.push(element("p", {}, `Strategies agreed: ${equal} of ${rounds}.`));
  const violations = audit.verdict === "ok" ? [] : audit.verdict;
  parts.push(element("h3", {}, violations.length ? "Violations" : "No violations"));
  parts.push(element("ul", {}, ...violations.map((line) => element("li", {}, line))));
  if (DATA.incidents.length) parts.push(incidentTable());
  byId("audit").append(...parts);
}

function taskTable(audit) {
  const columns = [
    ["agent", false], ["satisfied", true], ["claimed", true], ["longest gap/s", true],
    ["task", false], ["settled at/s", true], ["makespan/s", true], ["driven/m", true],
    ["messages", true],
  ];
  const rows = Object.entries(audit.tasks).map(([name, own]) => {
    const figures = DATA.metrics.agents[name];
    return [
      name, told(own.satisfied, 0), told(own.claimed, 0), told(own.longest_gap_s), own.verdict ?? "–",
      told(own.settled_s, 3), told(figures.makespan_s), told(figures.distance_m),
      told(figures.messages, 0),
    ];
  });
  return tableOf("Tasks", columns, rows);
}

function promiseTable(audit) {
  const rows = audit.guarantees.map(({ promise, kept, ...figures }) => [
    promise, kept ? "kept" : "BROKEN",
    Object.entries(figures)
      .filter(([, value]) => typeof value === "number")
      .map(([name, value]) => `${name} ${told(value, Number.isInteger(value) ? 0 : 3)}`).join(", "),
  ]);
  return tableOf("What the method promises", [["promise", false], ["", false], ["found", false]], rows);
}

function incidentTable() {
  const rows = DATA.incidents.map((own) => [
    told(own.time_s, 3), own.agent, own.kind, [own.region, own.action].join(" "), own.detail,
  ]);
  const columns = [["time/s", true], ["agent", false], ["what", false], ["at", false], ["detail", false]];
  return tableOf("Faults and changes", columns, rows);
}
