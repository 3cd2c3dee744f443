"""How near the comparisons with a threshold come to it: a copy of the sources that records, for each comparison
with a threshold, the ratio of its two sides, and the table of what was recorded.

    margins.py instrument ROOT COPY             the copy, with COPY/sites.json
    margins.py run COPY TARGET SEED CAMPAIGN... 30 simulated campaigns of a seed and each campaign file, a record of each
    margins.py table COPY OUT                   the table of what was recorded

The tests of the copy, run with LISSOM_MARGINS=COPY/tests, show which thresholds they reach from both sides.

A comparison is `<`, `<=`, `>` or `>=`, or a limit by `min`, `max` or `clamp`, one of whose sides has a threshold in it:
by its name, by a local name or constant that was made from it, or by a function that returns it.
"""

import argparse
import json
import math
import os
import re
import shutil
import subprocess
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import tree_sitter_rust
from tree_sitter import Language, Parser

PARSER = Parser(Language(tree_sitter_rust.language()))
ORDER = {"<", "<=", ">", ">="}
LIMITS = {"min", "max", "clamp"}

RECORDER = r"""
//! What the comparisons with thresholds saw.
use std::sync::Mutex;

/// Counts between the edges, the nearest ratio below one and the nearest from one on.
#[derive(Clone, Copy)]
struct Site { bins: [u64; 6], below: f64, above: f64 }

const NONE: Site = Site { bins: [0; 6], below: f64::NEG_INFINITY, above: f64::INFINITY };
static SITES: [Mutex<Site>; COUNT] = [const { Mutex::new(NONE) }; COUNT];

/// A number that is compared.
pub trait Compared { fn number(&self) -> f64; }
macro_rules! compared { ($($t:ty),+) => { $(impl Compared for $t { fn number(&self) -> f64 { *self as f64 } })+ } }
compared!(f64, f32, usize, u64, u32, u16, u8, isize, i64, i32);
impl<T: Compared> Compared for &T { fn number(&self) -> f64 { (**self).number() } }
impl Compared for std::time::Duration { fn number(&self) -> f64 { self.as_secs_f64() } }

/// Records a comparison.
pub fn note(site: usize, left: &impl Compared, right: &impl Compared) {
    STARTED.call_once(|| unsafe { atexit(write); });
    let ratio = left.number() / right.number();
    if ratio.is_nan() { return; }
    let bin = [0.125, 0.5, 1.0, 2.0, 8.0].iter().filter(|edge| ratio >= **edge).count();
    let mut site = SITES[site].lock().unwrap();
    site.bins[bin] += 1;
    if ratio < 1.0 { site.below = site.below.max(ratio) } else { site.above = site.above.min(ratio) }
}

unsafe extern "C" { fn atexit(at_end: extern "C" fn()) -> i32; }
static STARTED: std::sync::Once = std::sync::Once::new();

/// At the end of the program, writes the records to a new file in the folder that `LISSOM_MARGINS` names.
extern "C" fn write() {
    let Some(folder) = std::env::var_os("LISSOM_MARGINS") else { return };
    let mut text = String::new();
    for (i, site) in SITES.iter().enumerate() {
        let s = site.lock().unwrap();
        if s.bins.iter().any(|n| *n > 0) {
            text += &format!("{i} {:?} {:e} {:e}\n", s.bins, s.below, s.above);
        }
    }
    let path = std::path::Path::new(&folder).join(std::process::id().to_string());
    let _ = std::fs::write(path, text.replace(['[', ']', ','], ""));
}
"""


def walk(node):
    yield node
    for child in node.children:
        yield from walk(child)


def text(node):
    return node.text.decode()


def declared(source):
    """Names of the thresholds of a file, each with its method and what the list says of it."""
    names, method = {}, ""
    for line in source.splitlines():
        if found := re.match(r'    "([^"]+)" \{', line):
            method = found[1]
        if found := re.match(r'\s+([A-Z][A-Z0-9_]+): ([^=]+) = (.+), "([^"]*)", (\w+);', line):
            names[found[1]] = {"method": method, "kind": found[2], "value": found[3], "unit": found[4],
                               "basis": found[5]}
    return names


class File:
    """One source file, and where it compares with thresholds."""

    def __init__(self, path, thresholds):
        self.path, self.bytes = path, path.read_bytes()
        self.tree = PARSER.parse(self.bytes)
        self.thresholds = thresholds

    def mentioned(self, node, local):
        """The thresholds in an expression; what stands in a comparison inside it is not its value."""
        if node.type == "binary_expression" and text(node.child_by_field_name("operator")) in ORDER | {"==", "!=", "&&", "||"}:
            return set()
        if node.type in ("identifier", "scoped_identifier"):
            name = text(node).split("::")[-1]
            if name in self.thresholds:
                return {name}
            return local.get(name, set())
        if node.type == "call_expression":
            function = node.child_by_field_name("function")
            name = text(function).split("::")[-1].split(".")[-1]
            found = set(RETURNED.get(name, set()))
            for child in node.children:
                found |= self.mentioned(child, local)
            return found
        if node.type in ("closure_expression", "block", "match_expression", "macro_invocation"):
            if node.type != "block" or node.named_child_count != 1:
                return set()
        found = set()
        for child in node.children:
            found |= self.mentioned(child, local)
        return found

    def functions(self):
        for node in walk(self.tree.root_node):
            if node.type == "function_item":
                yield node

    def is_test(self, node):
        while node is not None:
            if node.type == "mod_item" and text(node.child_by_field_name("name")) == "tests":
                return True
            node = node.parent
        return False

    def constants(self):
        local = {}
        for node in walk(self.tree.root_node):
            if node.type == "const_item" and (value := node.child_by_field_name("value")):
                if names := self.mentioned(value, {}):
                    local[text(node.child_by_field_name("name"))] = names
        return local

    def contained(self, node, local):
        """`(low..high).contains(&x)` with a threshold in `low` or `high`."""
        if node.type != "call_expression" or node.child_by_field_name("function").type != "field_expression":
            return None
        function = node.child_by_field_name("function")
        inner = function.child_by_field_name("value")
        if text(function.child_by_field_name("field")) != "contains" or inner.type != "parenthesized_expression":
            return None
        span = inner.named_children[0]
        if span.type != "range_expression" or not (names := self.mentioned(span, local)):
            return None
        return node, "contains", names

    def sites(self):
        """(node, operator or method, thresholds of its sides)."""
        constants = self.constants()
        for function in self.functions():
            if self.is_test(function) or re.match(r"(pub(\([^)]*\))? )?const fn", text(function)):
                continue
            local = dict(constants)
            for node in walk(function.child_by_field_name("body") or function):
                if node.type == "let_declaration" and (value := node.child_by_field_name("value")):
                    pattern = node.child_by_field_name("pattern")
                    if pattern.type == "identifier" and (names := self.mentioned(value, local)):
                        local[text(pattern)] = names
                if node.type == "binary_expression" and text(node.child_by_field_name("operator")) in ORDER:
                    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
                    names = self.mentioned(left, local) | self.mentioned(right, local)
                    if names:
                        yield node, text(node.child_by_field_name("operator")), names
                if found := self.contained(node, local):
                    yield found
                if node.type == "call_expression" and node.child_by_field_name("function").type == "field_expression":
                    field = node.child_by_field_name("function").child_by_field_name("field")
                    arguments = node.child_by_field_name("arguments").named_children
                    if text(field) in LIMITS and len(arguments) == (2 if text(field) == "clamp" else 1):
                        names = set().union(*(self.mentioned(a, local) for a in arguments))
                        names |= self.mentioned(node.child_by_field_name("function").child_by_field_name("value"), local)
                        if names:
                            yield node, text(field), names


RETURNED = {}


def rewrite(data, edits):
    """The bytes with the edits made, inner ones first: an edit is (start, end, function of the inner text)."""
    def render(start, end, inside):
        out, at = b"", start
        for edit in top(inside):
            nested = [e for e in inside if e is not edit and edit[0] <= e[0] and e[1] <= edit[1]]
            out += data[at:edit[0]] + edit[2](lambda s, e: render(s, e, [n for n in nested if s <= n[0] and n[1] <= e]))
            at = edit[1]
        return out + data[at:end]

    def top(inside):
        chosen = []
        for edit in sorted(inside, key=lambda e: (e[0], -e[1])):
            if not chosen or edit[0] >= chosen[-1][1]:
                chosen.append(edit)
        return chosen

    return render(0, len(data), edits)


def instrument(root, copy):
    files = subprocess.run(["git", "ls-files"], cwd=root,
                           check=True, capture_output=True, text=True).stdout.split()
    for name in files:
        target = copy / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(root / name, target)
    library = copy / "crates/lissom-core/src"
    (copy / "tests").mkdir(exist_ok=True)
    thresholds = {}
    for path in sorted(library.rglob("*.rs")):
        if "thresholds! {" in path.read_text() and path.name != "threshold.rs":
            thresholds |= declared(path.read_text())
    sources = [File(path, thresholds) for path in sorted(library.rglob("*.rs")) if path.name not in ("threshold.rs", "thresholds.rs")]
    returned = defaultdict(list)
    for file in sources:
        for function in file.functions():
            body = function.child_by_field_name("body")
            result = function.child_by_field_name("return_type")
            if body is None or result is None or text(result) not in ("f64", "usize", "u64") or not body.named_children:
                continue
            last = body.named_children[-1]
            returned[text(function.child_by_field_name("name"))].append(file.mentioned(last, file.constants()))
    RETURNED.update({name: found[0] for name, found in returned.items() if len(found) == 1 and found[0]})
    sites = []
    for file in sources:
        edits = []
        for node, operator, names in file.sites():
            number = len(sites)
            sites.append({"file": str(file.path.relative_to(library)), "line": node.start_point[0] + 1,
                          "operator": operator, "thresholds": sorted(names), "text": text(node)})
            if operator in ORDER:
                left, right = node.child_by_field_name("left"), node.child_by_field_name("right")

                def edit(inner, left=left, right=right, operator=operator, number=number):
                    a, b = inner(left.start_byte, left.end_byte), inner(right.start_byte, right.end_byte)
                    return (b"({ let (a__, b__) = (" + a + b", " + b + b"); crate::margins::note(%d, &a__, &b__); a__ " % number
                            + operator.encode() + b" b__ })")
            elif operator == "contains":
                ends = node.child_by_field_name("function").child_by_field_name("value").named_children[0]
                argument = node.child_by_field_name("arguments").named_children[0]

                def edit(inner, ends=ends, argument=argument, number=number):
                    notes = b""
                    for end in ends.named_children:
                        e = inner(end.start_byte, end.end_byte)
                        notes += b"crate::margins::note(%d, x__, &(%s)); " % (number, e)
                    x = inner(argument.start_byte, argument.end_byte)
                    whole = inner(ends.start_byte, ends.end_byte)
                    return b"({ let x__ = " + x + b"; " + notes + b"(" + whole + b").contains(x__) })"
            else:
                value = node.child_by_field_name("function").child_by_field_name("value")
                arguments = node.child_by_field_name("arguments").named_children

                def edit(inner, value=value, arguments=arguments, operator=operator, number=number):
                    a = inner(value.start_byte, value.end_byte)
                    others = [inner(b.start_byte, b.end_byte) for b in arguments]
                    names = [b"b%d__" % i for i in range(len(others))]
                    notes = b"".join(b"crate::margins::note(%d, &a__, &%s); " % (number, n) for n in names)
                    return (b"({ let (a__, " + b", ".join(names) + b") = (" + b", ".join([a, *others]) + b"); " + notes
                            + b"a__." + operator.encode() + b"(" + b", ".join(names) + b") })")
            edits.append((node.start_byte, node.end_byte, edit))
        if edits:
            file.path.write_bytes(rewrite(file.bytes, edits))
    (library / "margins.rs").write_text(RECORDER.replace("COUNT]", f"{len(sites)}]"))
    lib = (library / "lib.rs").read_text()
    (library / "lib.rs").write_text(lib + "\n#[allow(missing_docs, clippy::all)]\npub mod margins;\n")
    manifest = (copy / "Cargo.toml").read_text()
    (copy / "Cargo.toml").write_text(manifest.replace('unsafe_code = "forbid"', ""))
    (copy / "sites.json").write_text(json.dumps({"thresholds": thresholds, "sites": sites}, indent=1))
    print(f"{len(sites)} comparisons with {len(set().union(*(s['thresholds'] for s in sites)))} of {len(thresholds)} thresholds")


def run(copy, target, seed, campaigns):
    """Identifies 30 simulated campaigns and the given ones with the copy's programs, two at a time."""
    records = copy / "records"
    shutil.rmtree(records, ignore_errors=True)
    records.mkdir()
    study, lissom = target / "release/lissom-study", target / "release/lissom"
    jobs = {}
    for kind in (["--drives", "real"], ["--drives", "causes"], []):
        for index in range(10):
            command = [study, *kind, "--seed", str(seed), "--only", str(index)]
            jobs[f"simulated-{(kind or ['arms'])[-1]}-{index}"] = [command]
    for path in campaigns:
        result = copy / "result" / f"{path.parent.name}-{path.stem}.json"
        result.parent.mkdir(exist_ok=True)
        jobs[f"given-{result.stem}"] = [
            [lissom, "identify", path, "--json", result],
            [lissom, "validate", result, path],
            [lissom, "equivalent", path],
        ]

    def one(job):
        name, commands = job
        (records / name).mkdir()
        environment = os.environ | {"LISSOM_MARGINS": str(records / name), "RAYON_NUM_THREADS": "1"}
        run = lambda command: subprocess.run(command, env=environment, capture_output=True, text=True)
        return name, [run(command).returncode for command in commands]

    with ThreadPoolExecutor(2) as pool:
        for name, codes in pool.map(one, jobs.items()):
            print(f"{name}: exit codes {codes}", flush=True)


class Seen:
    """What all comparisons with one threshold saw."""

    def __init__(self):
        self.bins, self.below, self.above = [0] * 6, -math.inf, math.inf
        self.logs, self.near = set(), set()

    def add(self, log, bins, below, above):
        self.bins = [a + b for a, b in zip(self.bins, bins)]
        self.below, self.above = max(self.below, below), min(self.above, above)
        self.logs.add(log)
        if below >= 0.5 or above <= 2:
            self.near.add(log)


def ratio(value):
    if not math.isfinite(value):
        return ""
    return f"{value:.3g}" if 1e-3 < abs(value) < 1e4 else f"{value:.0e}"


def recorded(known, folders):
    """What each threshold's comparisons saw, by the records in the folders."""
    seen = {name: Seen() for name in known["thresholds"]}
    for folder in folders:
        for line in "".join(file.read_text() for file in folder.iterdir()).splitlines():
            site, *bins, below, above = line.split()
            for name in known["sites"][int(site)]["thresholds"]:
                seen[name].add(folder.name, [int(n) for n in bins], float(below), float(above))
    return seen


def table(copy, out):
    known = json.loads((copy / "sites.json").read_text())
    campaigns = sorted((copy / "records").iterdir())
    seen, tested = recorded(known, campaigns), recorded(known, [copy / "tests"])
    compared = {name for site in known["sites"] for name in site["thresholds"]}
    groups = {"near": [], "tested": [], "neither": [], "value": []}
    for name, s in seen.items():
        both = math.isfinite(tested[name].below) and math.isfinite(tested[name].above)
        kind = "value" if name not in compared else "near" if s.near else "tested" if both or tested[name].near else "neither"
        groups[kind].append(name)
    print({kind: len(names) for kind, names in groups.items()})
    titles = {
        "near": "Thresholds that a campaign comes near",
        "tested": "Guards: no campaign comes near, tests do or decide both ways",
        "neither": "Neither",
        "value": "Numbers in no comparison",
    }
    lines = []
    for kind, title in titles.items():
        lines += [f"## {title} ({len(groups[kind])})", ""]
        if kind == "value":
            lines += ["| threshold | value |", "|---|---|"]
            lines += [f"| `{name}` ({known['thresholds'][name]['method']}) | {known['thresholds'][name]['value']} |" for name in groups[kind]]
        else:
            lines += ["| threshold | value | campaigns that compare | come near | of the comparisons near | nearest below | nearest above | "
                      "tests: nearest below | above |", "|---|---|---|---|---|---|---|---|---|"]
        for name in groups[kind] if kind != "value" else []:
            s, tests, t = seen[name], tested[name], known["thresholds"][name]
            total = sum(s.bins)
            unit = "" if t["unit"] == "1" else f" {t['unit']}"
            near = 100 * (s.bins[2] + s.bins[3]) / max(total, 1)
            share = (f"{near:.0f} %" if near >= 10 else f"{near:.2g} %") if total else ""
            lines.append(f"| `{name}` ({t['method']}) | {t['value']}{unit} | {len(s.logs)} | {len(s.near)} | {share} | "
                         f"{ratio(s.below)} | {ratio(s.above)} | {ratio(tests.below)} | {ratio(tests.above)} |")
        lines.append("")
    out.write_text("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("instrument")
    one.add_argument("root", type=Path)
    one.add_argument("copy", type=Path)
    one = commands.add_parser("run")
    one.add_argument("copy", type=Path)
    one.add_argument("target", type=Path)
    one.add_argument("seed", type=int)
    one.add_argument("campaigns", type=Path, nargs="*")
    one = commands.add_parser("table")
    one.add_argument("copy", type=Path)
    one.add_argument("out", type=Path)
    args = parser.parse_args()
    if args.command == "instrument":
        instrument(args.root, args.copy)
    elif args.command == "run":
        run(args.copy, args.target, args.seed, args.campaigns)
    else:
        table(args.copy, args.out)


if __name__ == "__main__":
    main()
