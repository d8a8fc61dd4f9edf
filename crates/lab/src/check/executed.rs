//! What a program executed, instruction by instruction: work, and what the compiler arranges around it.
//!
//! Two builds of the same arithmetic differ in the order of their blocks and in what they keep in registers. A count of all
//! instructions moves by a per cent with that. Work does not: arithmetic, comparisons, branches and calls.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Sub;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::check::stepping::{self, Vectors};
use fmu_build::tools::paths;

/// Kinds of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Conditional jumps, calls and returns.
    Branch,
    /// Moves and copies of memory, jumps that are always taken, padding, and integer arithmetic, most of it for addresses.
    Arranged,
    /// Arithmetic and comparisons of floating-point numbers.
    Float,
}

impl Kind {
    /// The kind of an instruction of the program itself.
    fn of(mnemonic: &str) -> Self {
        // `v` marks the encoding of wide registers
        let plain = mnemonic.strip_prefix('v').unwrap_or(mnemonic);
        let ends = |endings: &[&str]| endings.iter().any(|ending| plain.ends_with(ending));
        let starts = |starts: &[&str]| starts.iter().any(|start| plain.starts_with(start));
        if starts(&["call", "ret"]) || (plain.starts_with('j') && plain != "jmp") {
            Self::Branch
        } else if starts(&["mov", "xor", "broadcast", "unpck", "perm", "insert", "extract", "shuf", "blend"]) {
            Self::Arranged
        } else if ends(&["sd", "pd", "ss", "ps"]) {
            Self::Float
        } else {
            Self::Arranged
        }
    }
}

/// How often each kind of instruction was executed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Executed(BTreeMap<Kind, f64>);

impl Executed {
    /// Per communication step of `program` in `scene` with `options`.
    pub fn per_step(program: &Path, vectors: Vectors, scene: &str, options: &[&str]) -> Result<Self> {
        let mnemonics = mnemonics(program)?;
        let [few, many] = stepping::COUNTED.map(|steps| {
            let steps = steps.to_string();
            Self::of_run(program, vectors, &[&[scene, &steps, "unread"], options].concat(), &mnemonics)
        });
        let steps = f64::from(stepping::COUNTED[1] - stepping::COUNTED[0]);
        let difference = &many? - &few?;
        Ok(Self(difference.0.into_iter().map(|(kind, count)| (kind, count / steps)).collect()))
    }

    /// Of one kind.
    pub fn of(&self, kind: Kind) -> f64 {
        self.0.get(&kind).copied().unwrap_or(0.0)
    }

    /// Of all kinds.
    pub fn total(&self) -> f64 {
        self.0.values().sum()
    }

    fn of_run(program: &Path, vectors: Vectors, arguments: &[&str], mnemonics: &BTreeMap<u64, String>) -> Result<Self> {
        let file = paths::target().join("off/executed.callgrind");
        let out = format!("--callgrind-out-file={}", file.display());
        let options = [&*out, "--dump-instr=yes", "--compress-pos=no", "--compress-strings=no"];
        stepping::callgrind(program, vectors, &options, arguments)?;
        let profile = fs::read_to_string(&file).with_context(|| format!("reading {}", file.display()))?;
        fs::remove_file(&file)?;
        let executed = Self::of_profile(&profile, &program.to_string_lossy(), mnemonics)?;
        ensure!(executed.of(Kind::Float) > 0.0, "{arguments:?}: callgrind named no instruction of the program itself");
        Ok(executed)
    }

    /// Reads what callgrind wrote, see its manual, "Callgrind Format Specification".
    fn of_profile(profile: &str, program: &str, mnemonics: &BTreeMap<u64, String>) -> Result<Self> {
        let mut counts = Self::default();
        let mut inside = false;
        // the line after `calls=` has what the called function executed, which is counted there
        let mut is_of_call = false;
        for line in profile.lines() {
            if let Some(object) = line.strip_prefix("ob=") {
                inside = object == program;
            } else if line.starts_with("calls=") {
                is_of_call = true;
            } else if let Some(position) = line.strip_prefix("0x") {
                if std::mem::take(&mut is_of_call) {
                    continue;
                }
                let mut words = position.split_whitespace();
                let address = words.next().and_then(|address| u64::from_str_radix(address, 16).ok());
                let count = words.nth(1).and_then(|count| count.parse::<f64>().ok());
                let (address, count) = address.zip(count).with_context(|| format!("callgrind wrote {line:?}"))?;
                let kind = match mnemonics.get(&address) {
                    Some(mnemonic) if inside => Kind::of(mnemonic),
                    // other libraries copy memory: what that costs hangs on where it lies
                    _ => Kind::Arranged,
                };
                *counts.0.entry(kind).or_default() += count;
            }
        }
        Ok(counts)
    }
}

impl Sub for &Executed {
    type Output = Executed;

    fn sub(self, other: Self) -> Executed {
        Executed(self.0.iter().map(|(&kind, count)| (kind, count - other.of(kind))).collect())
    }
}

/// Name of the instruction at each address of a program.
fn mnemonics(program: &Path) -> Result<BTreeMap<u64, String>> {
    let output = Command::new("objdump")
        .args(["--disassemble", "--no-show-raw-insn"])
        .arg(program)
        .output()
        .context("objdump names the instructions: install it (apt-get install binutils)")?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8_lossy(&output.stdout).lines().filter_map(disassembled).collect())
}

/// Address and name in a line such as `4a10: vaddsd %xmm0,%xmm1,%xmm2`.
fn disassembled(line: &str) -> Option<(u64, String)> {
    let (address, rest) = line.split_once(':')?;
    let address = u64::from_str_radix(address.trim(), 16).ok()?;
    Some((address, rest.split_whitespace().next()?.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_and_branches_are_work_and_moves_are_not() {
        let float = ["vaddsd", "mulsd", "vfmadd213pd", "ucomisd", "vsqrtsd", "vandpd", "vcvtsi2sd", "vmaxsd"];
        assert!(float.iter().all(|mnemonic| Kind::of(mnemonic) == Kind::Float));
        assert!(["ja", "jbe", "call", "ret"].iter().all(|mnemonic| Kind::of(mnemonic) == Kind::Branch));
        let arranged = ["vmovsd", "mov", "jmp", "nopw", "vxorpd", "xor", "lea", "add", "vunpcklpd", "data16"];
        assert!(arranged.iter().all(|mnemonic| Kind::of(mnemonic) == Kind::Arranged));
    }

    #[test]
    fn a_profile_is_counted_without_what_its_calls_contain() {
        let profile =
            "ob=/p\nfn=f\n0x10 1 5\n0x14 1 5\ncalls=5 0x90\n0x14 1 1000\nob=/libc.so.6\nfn=memcpy\n0x10 3 7\n";
        let lines = ["  10:\tvaddsd %xmm0,%xmm1,%xmm2", "  14:\tcall 90"];
        let mnemonics = lines.iter().filter_map(|line| disassembled(line)).collect();
        let executed = Executed::of_profile(profile, "/p", &mnemonics).unwrap();
        assert_eq!([Kind::Float, Kind::Branch, Kind::Arranged].map(|kind| executed.of(kind)), [5.0, 5.0, 7.0]);
        assert_eq!(executed.total(), 17.0);
    }
}
