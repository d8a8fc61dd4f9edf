//! Translates the output of wasm2c: the result is smaller, independent of wasm2c's runtime, and consists of C files of
//! bounded size on top of `bd_runtime.h`.
//!
//! wasm2c writes one statement per line, in a fixed form. Each line is rewritten independently: memory is part of the
//! instance `s`, whose size the compiler knows; functions are called through one constant table; names are short.

use std::fmt::Write as _;

use anyhow::{Context, Result, bail};

/// Approximate size of a file in bytes.
const FILE: usize = 1_000_000;
/// Prefix that wasm2c adds to names from the library.
const NAMED: &str = "w2c_bd_";
/// Start of every memory access.
const ACCESS: &str = "_default32(wasm_rt_local_memory_base, wasm_rt_local_memory_size, &instance->w2c_memory, (u64)(";
/// Prefix of globals that the library changes. Other globals only contain the end of its data.
const GLOBAL: &str = "instance->w2c_g";
/// Starts of lines that are dropped: comments, directives, copies of the memory's base and size, and counts of calls.
const DROPPED: [&str; 9] = [
    "#",
    "wasm_rt_segue_write_base(",
    "uint8_t* const wasm_rt_local_memory_base",
    "uint64_t wasm_rt_local_memory_size",
    "wasm_rt_local_memory_size =",
    "(void)wasm_rt_local_memory",
    "FUNC_PROLOGUE;",
    "FUNC_EPILOGUE;",
    "//",
];
/// Replacements of names.
const SHORTER: [(&str, &str); 6] = [
    ("&instance->w2c_memory, &instance->w2c_memory, ", "s, "),
    ("&instance->w2c_memory", "s"),
    (GLOBAL, "s->g"),
    ("var_", ""),
    ("UNREACHABLE;", "bd_trap(s, BD_UNREACHABLE);"),
    ("wasm_rt_grow_memory(", "memory_grow("),
];

/// A C file: name and text.
pub type File = (String, String);

/// Converts `text`, the output of wasm2c, into files: a header, then the sources.
pub fn files(text: &str) -> Result<Vec<File>> {
    let parts = Parts::of(text)?;
    let mut files = vec![("bd_library.h".to_owned(), parts.header()?), ("bd_library.c".to_owned(), parts.tables()?)];
    let mut body = String::new();
    for (k, function) in parts.functions.iter().enumerate() {
        body.push_str(&self::function(function)?);
        if body.len() > FILE || k + 1 == parts.functions.len() {
            let name = format!("bd_library_{:02}.c", files.len() - 1);
            files.push((name, format!("{HEAD}#include \"bd_library.h\"\n{body}")));
            body.clear();
        }
    }
    Ok(files)
}

/// First line of every file.
const HEAD: &str = "/* made by wasm2c from the library in Rust; see bd_runtime.h */\n";

/// Relevant parts of wasm2c's output.
struct Parts<'a> {
    /// Declarations of functions, `static u32 w2c_bd_f0(w2c_bd*, u32);`.
    declared: Vec<&'a str>,
    /// Functions, each from its first to its last line.
    functions: Vec<&'a str>,
    /// Assignments of the initial values of globals.
    globals: Vec<&'a str>,
    /// Entries of the table of functions.
    entries: Vec<&'a str>,
    /// Name and bytes of the data segments.
    data: Vec<(&'a str, &'a str)>,
    /// Line that contains the initial size of the table of functions.
    table: &'a str,
    /// Line that contains the initial size of the memory.
    memory: &'a str,
    /// Lines that copy data segments into the memory.
    loads: Vec<&'a str>,
}

impl<'a> Parts<'a> {
    fn of(text: &'a str) -> Result<Self> {
        let line = |beginning: &str| text.lines().map(str::trim).find(|line| line.starts_with(beginning));
        let block = |beginning: &str| {
            let from = text.find(beginning)? + beginning.len();
            Some(&text[from..from + text[from..].find("\n}")?])
        };
        let mut functions = Vec::new();
        let mut exported = false;
        let mut rest = text;
        while let Some(end) = rest.find("\n}\n") {
            let (part, after) = rest.split_at(end + 3);
            let part = part.trim_start();
            let begin = part.rfind("\n\n").map_or(0, |at| at + 2);
            // the function after a comment about an export only calls the function of that name
            exported |= part[begin..].starts_with("/* export");
            let first = part[begin..].lines().find(|line| !line.starts_with("/*")).unwrap_or_default();
            if first.contains("(w2c_bd* instance") && first.contains(NAMED) && !exported {
                functions.push(&part[begin..]);
            }
            exported = false;
            rest = after;
        }
        let data = text.match_indices("static const u8 data_segment_data_w2c_bd_").filter_map(|(at, head)| {
            let (name, bytes) = text[at + head.len()..].split_once("[] = {")?;
            Some((name, bytes.split_once('}')?.0))
        });
        Ok(Self {
            declared: text
                .lines()
                .filter(|line| line.starts_with("static ") && line.contains("(w2c_bd*") && line.ends_with(");"))
                .collect(),
            functions,
            globals: block("static void init_globals(w2c_bd* instance) {")
                .context("no globals")?
                .lines()
                .map(str::trim)
                .filter(|line| line.starts_with(GLOBAL))
                .collect(),
            entries: text.lines().map(str::trim).filter(|line| line.starts_with("{Ref")).collect(),
            data: data.collect(),
            table: line("funcref_table_init(").context("no table of functions")?,
            memory: line("wasm_rt_allocate_memory(").context("no memory")?,
            loads: text.lines().map(str::trim).filter(|line| line.starts_with("LOAD_DATA(instance")).collect(),
        })
    }

    /// Header: declarations, and the initial size of memory.
    fn header(&self) -> Result<String> {
        let mut out = format!("{HEAD}#ifndef BD_LIBRARY_H\n#define BD_LIBRARY_H\n");
        let pages = arguments(self.memory).nth(1).context("memory of unknown size")?;
        writeln!(out, "#define BD_FIRST_PAGES {pages}u")?;
        // the first global is the stack pointer: it starts at the end of the stack, which grows towards 0
        let stack =
            self.globals.first().and_then(|line| line.split("= ").nth(1)).context("a library without a stack")?;
        writeln!(out, "#define BD_STACK {}", stack.trim_end_matches(';'))?;
        writeln!(
            out,
            "#define BD_GLOBALS {}",
            self.globals.iter().map(|line| format!("u32 g{};", global(line))).collect::<String>()
        )?;
        out.push_str("#include \"bd_runtime.h\"\nBD_HIDDEN\n");
        for declared in &self.declared {
            writeln!(out, "{}", renamed(declared.trim_start_matches("static ")).replace("w2c_bd*", "bd *"))?;
        }
        out.push_str("BD_SEEN\n#endif\n");
        Ok(out)
    }

    /// Source file with the table of functions and the initial content of memory.
    fn tables(&self) -> Result<String> {
        let mut out = format!("{HEAD}#include \"bd_library.h\"\n#include <string.h>\n");
        let first: usize = arguments(self.table)
            .nth(3)
            .and_then(|first| first.trim_end_matches('u').parse().ok())
            .context("a table that begins nowhere")?;
        let count = first + self.entries.len();
        writeln!(out, "const u32 bd_table_size = {count}u;\nconst bd_entry bd_table[] = {{")?;
        out.push_str(&"{0, 0},\n".repeat(first));
        for entry in &self.entries {
            let [kind, function] = [1, 2].map(|k| arguments(entry).nth(k).unwrap_or_default());
            let function = function.split("wrap_").last().unwrap_or_default();
            if !entry.starts_with("{RefFunc") || function.is_empty() {
                bail!("an entry of unknown kind: {entry}");
            }
            writeln!(out, "{{(bd_function *){}, {}}},", renamed(function), kind.trim_start_matches("w2c_bd_t"))?;
        }
        out.push_str("};\n");
        for (name, bytes) in &self.data {
            let bytes =
                bytes.split(',').filter_map(|byte| u8::from_str_radix(byte.trim().trim_start_matches("0x"), 16).ok());
            writeln!(out, "static const u8 {name}[] = {{")?;
            let mut column = 0;
            for byte in bytes {
                write!(out, "{byte},")?;
                column += 1;
                if column % 40 == 0 {
                    out.push('\n');
                }
            }
            out.push_str("};\n");
        }
        out.push_str("void bd_library_start(bd *s) {\n");
        for line in &self.globals {
            writeln!(out, "{}", line.replace(GLOBAL, "s->g"))?;
        }
        for load in &self.loads {
            let [place, name, count] = [1, 2, 3].map(|k| arguments(load).nth(k).unwrap_or_default());
            writeln!(
                out,
                "memcpy(s->memory.bytes + {place}, {}, {});",
                name.trim_start_matches("data_segment_data_w2c_bd_"),
                count.trim_end_matches(')')
            )?;
        }
        out.push_str("}\n");
        Ok(out)
    }
}

/// Number of the global to which a line assigns.
fn global(line: &str) -> &str {
    line.trim_start_matches(GLOBAL).split(' ').next().unwrap_or_default()
}

/// Arguments of a call, or elements in braces.
fn arguments(line: &str) -> impl Iterator<Item = &str> {
    let inner = line.split_once(['(', '{']).map_or("", |(_, inner)| inner);
    inner.trim_end_matches([';', ',', '}']).split(", ").map(str::trim)
}

/// Translates a function.
fn function(text: &str) -> Result<String> {
    let mut out = String::with_capacity(text.len() / 2);
    // operands that wait for the statement that takes them
    let mut operands: Vec<String> = Vec::new();
    for line in text.lines() {
        let line = line.trim();
        if line.is_empty() || DROPPED.iter().any(|dropped| line.starts_with(dropped)) {
            continue;
        }
        let mut line = statement(line)?;
        if operand(&line).is_some() {
            operands.push(line);
            continue;
        }
        while let Some(with) = operands.last().and_then(|last| with_operand(&line, last)) {
            line = with;
            operands.pop();
        }
        for line in operands.drain(..).chain([line]) {
            out.push_str(&line);
            out.push('\n');
        }
    }
    Ok(out)
}

/// Name and value of an operand of WebAssembly's stack, if `line` assigns a local variable or a constant to it.
fn operand(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.strip_suffix(';')?.split_once('=')?;
    let starts_with = |text: &str, of: &str| text.starts_with(|first: char| of.contains(first));
    let is_plain = value.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c));
    let is_value = starts_with(value, "lp0123456789-") && !value.starts_with("-l");
    (is_operand(name) && is_plain && is_value).then_some((name, value))
}

/// True if `name` is that of an operand, such as `i3`.
fn is_operand(name: &str) -> bool {
    name.strip_prefix(['i', 'j', 'f', 'd']).is_some_and(|number| number.parse::<u32>().is_ok())
}

/// `line` with the value of the `last` operand instead of its name. `None` if the line does not take it, or if the
/// operand may be needed afterwards: only a copy leaves its operand on the stack.
fn with_operand(line: &str, last: &str) -> Option<String> {
    let (name, value) = operand(last)?;
    if line.strip_suffix(';')?.split_once('=').is_some_and(|(_, from)| is_operand(from)) {
        return None;
    }
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut places = line
        .match_indices(name)
        .map(|(at, _)| (at, at + name.len()))
        .filter(|&(from, to)| !line[..from].ends_with(is_part) && !line[to..].starts_with(is_part));
    let (mut from, mut to) = places.next()?;
    let after = &line[to..];
    if from == 0 && after.starts_with('=') && !after.starts_with("==") {
        // the result takes the place of the operand
        (from, to) = places.next()?;
    } else if from == 0 && after.contains('=') {
        return None;
    }
    places.next().is_none().then(|| format!("{}{value}{}", &line[..from], &line[to..]))
}

/// Translates a line of a function.
fn statement(line: &str) -> Result<String> {
    let mut line = line.to_owned();
    if let Some(at) = line.find(ACCESS) {
        line = access(&line, at).with_context(|| format!("an access of unknown form: {line}"))?;
    }
    if let Some(at) = line.find("CALL_INDIRECT(") {
        line = indirect(&line, at).with_context(|| format!("a call of unknown form: {line}"))?;
    }
    for (long, short) in SHORTER {
        line = line.replace(long, short);
    }
    let line = renamed(&line).replace("w2c_bd* instance", "bd *s").replace("(instance", "(s");
    if line.contains("instance") || line.contains("wasm_rt") {
        bail!("a statement of unknown form: {line}");
    }
    Ok(without_spaces(&line))
}

/// Removes spaces that separate no words.
fn without_spaces(line: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let separates = |before: &str, after: &str| {
        before.ends_with(is_word) && after.starts_with(is_word) || before.ends_with('-') && after.starts_with('-')
    };
    let mut out = String::with_capacity(line.len());
    for (at, c) in line.char_indices() {
        if c != ' ' || separates(&line[..at], &line[at + 1..]) {
            out.push(c);
        }
    }
    out
}

/// `f64_load_default32(…, (u64)(var_i0) + 8u)` → `f64_load(s, var_i0, 8u)`.
fn access(line: &str, at: usize) -> Option<String> {
    let (place, rest) = line[at + ACCESS.len()..].split_once(')')?;
    let (offset, rest) = match rest.strip_prefix(" + ") {
        Some(rest) => rest.split_at(rest.find([',', ')'])?),
        None => ("0u", rest),
    };
    Some(format!("{}(s, {place}, {offset}{rest}", &line[..at]))
}

/// `CALL_INDIRECT(instance->w2c_T0, u32 (*)(void*, u32), w2c_bd_t3, var_i3, instance->…, var_i0)` →
/// `bd_call(u32 (*)(bd *, u32), 3, var_i3)(s, var_i0)`.
fn indirect(line: &str, at: usize) -> Option<String> {
    let rest = line[at..].strip_prefix("CALL_INDIRECT(instance->w2c_T0, ")?;
    let (of, rest) = rest.split_once(", w2c_bd_t")?;
    let (kind, rest) = rest.split_once(", ")?;
    let (place, rest) = rest.split_once(", ")?;
    let rest = rest.strip_prefix(&format!("instance->w2c_T0.data[{place}].module_instance"))?;
    Some(format!("{}bd_call({}, {kind}, {place})(s{rest}", &line[..at], of.replace("void*", "bd *")))
}

/// Replaces the names of functions with names that no other part of a program uses.
fn renamed(line: &str) -> String {
    line.replace(NAMED, "bd_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_rewritten() {
        for (from, to) in [
            (
                "var_d0 = f64_load_default32(wasm_rt_local_memory_base, wasm_rt_local_memory_size, &instance->w2c_memory, (u64)(var_i0) + 8u);",
                "d0=f64_load(s,i0,8u);",
            ),
            (
                "i32_store8_default32(wasm_rt_local_memory_base, wasm_rt_local_memory_size, &instance->w2c_memory, (u64)(var_i0), var_i1);",
                "i32_store8(s,i0,0u,i1);",
            ),
            (
                "var_i0 = CALL_INDIRECT(instance->w2c_T0, u32 (*)(void*, u32, f64), w2c_bd_t3, var_i3, instance->w2c_T0.data[var_i3].module_instance, var_i0, var_d1);",
                "i0=bd_call(u32(*)(bd*,u32,f64),3,i3)(s,i0,d1);",
            ),
            ("var_i0 = w2c_bd_f143(instance, var_i0);", "i0=bd_f143(s,i0);"),
            (
                "memory_copy(&instance->w2c_memory, &instance->w2c_memory, var_i0, var_i1, var_i2);",
                "memory_copy(s,i0,i1,i2);",
            ),
            ("instance->w2c_g0 = var_i0;", "s->g0=i0;"),
            ("if (var_i0) {goto var_B3;}", "if(i0){goto B3;}"),
        ] {
            assert_eq!(statement(from).unwrap(), to);
        }
        assert!(statement("wasm_rt_something_new(instance);").is_err());
    }

    #[test]
    fn operands_are_written_where_they_are_taken() {
        for (lines, to) in [
            (["var_j9 = 63ull;", "var_j8 >>= (var_j9 & 63);"], "j8>>=(63ull&63);\n"),
            (["var_i1 = var_l3;", "var_i1 = var_i1 > var_i2;"], "i1=l3>i2;\n"),
            (["var_i0 = var_p1;", "i32_store(var_i0, var_i1);"], "i32_store(p1,i1);\n"),
            // the next statement changes the operand, or leaves it on the stack, or takes another
            (["var_i1 = var_l3;", "var_i1 += 48u;"], "i1=l3;\ni1+=48u;\n"),
            (["var_i1 = var_l3;", "var_l4 = var_i1;"], "i1=l3;\nl4=i1;\n"),
            (["var_i1 = var_l3;", "var_i0 = var_i11 == var_i12;"], "i1=l3;\ni0=i11==i12;\n"),
        ] {
            assert_eq!(function(&lines.join("\n")).unwrap(), to);
        }
    }
}
