//! C interface of the questions: `bd_ask` and `bd_free`. No panic crosses it.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{ptr, slice};

use serde_json::json;

use super::{Refusal, ask};
use crate::progress::Progress;

/// Callback that receives the completed fraction of the work, from 0 to 1, and the name of the present task. `context`
/// is the pointer passed to `bd_ask`. Any result other than 0 stops the work.
#[allow(non_camel_case_types)]
pub type bd_progress = Option<unsafe extern "C" fn(context: *mut c_void, done: f64, what: *const c_char) -> c_int>;

/// Answers a question.
///
/// `question` is a JSON object in UTF-8 that ends with a zero byte; `numbers` are `count` numbers that belong to it.
/// `progress` may be null. The reply is JSON that ends with a zero byte, and `bd_free` must free it. The reply is
/// `{"answer": ...}`, or `{"kind": "use" | "failed" | "stopped" | "internal", "problems": [...]}`. Both contain
/// `"warnings": [...]`, texts about the scene or its gears without repetitions. The reply is null only if there is not
/// enough memory.
///
/// # Safety
/// `question` is null or points to a text with a zero byte at its end. `numbers` points to `count` numbers, or is null
/// with a count of 0. Both stay unchanged until the function returns. Several threads may call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bd_ask(
    question: *const c_char,
    numbers: *const f64,
    count: usize,
    progress: bd_progress,
    context: *mut c_void,
) -> *mut c_char {
    let replied = catch_unwind(|| {
        if question.is_null() {
            return reply(Err(Refusal::unreadable("there is no question: the pointer is null")), &[]);
        }
        if numbers.is_null() && count > 0 {
            return reply(Err(Refusal::unreadable(format!("the pointer to {count} numbers is null"))), &[]);
        }
        // SAFETY: the caller's promise
        let question = unsafe { CStr::from_ptr(question) };
        let numbers = if numbers.is_null() { &[] } else { unsafe { slice::from_raw_parts(numbers, count) } };
        let mut reports = Progress::new(|done, what| {
            let (Some(progress), Ok(what)) = (progress, CString::new(what)) else { return true };
            // SAFETY: the caller's function, with the caller's context
            unsafe { progress(context, done, what.as_ptr()) == 0 }
        });
        let answer = answer(question, numbers, &mut reports);
        reply(answer, reports.warnings())
    });
    replied.unwrap_or_else(|_| reply(Err(internal("a fault of this library")), &[]))
}

/// Frees a reply; null is ignored.
///
/// # Safety
/// `reply` was returned by `bd_ask` and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bd_free(reply: *mut c_char) {
    if !reply.is_null() {
        // SAFETY: the caller's promise
        drop(unsafe { CString::from_raw(reply) });
    }
}

/// Returns the reply to `question` that a caller in C gets, for tests. `go_on` is called from time to time.
pub fn as_in_c(question: &CStr, numbers: &[f64], mut go_on: impl FnMut() -> bool) -> String {
    unsafe extern "C" fn on_progress<F: FnMut() -> bool>(context: *mut c_void, _: f64, _: *const c_char) -> c_int {
        // SAFETY: the context is the closure below, which outlives the call
        let go_on = unsafe { &mut *context.cast::<F>() };
        c_int::from(!go_on())
    }
    fn of<F: FnMut() -> bool>(_: &F) -> bd_progress {
        Some(on_progress::<F>)
    }
    let progress = of(&go_on);
    let context = ptr::from_mut(&mut go_on).cast();
    // SAFETY: question and numbers live until the end, and the reply is freed once
    unsafe {
        let reply = bd_ask(question.as_ptr(), numbers.as_ptr(), numbers.len(), progress, context);
        let text = CStr::from_ptr(reply).to_string_lossy().into_owned();
        bd_free(reply);
        text
    }
}

fn answer(question: &CStr, numbers: &[f64], progress: &mut Progress) -> Result<serde_json::Value, Refusal> {
    let text = question.to_str().map_err(|why| Refusal::unreadable(format!("the question is not UTF-8: {why}")))?;
    let question =
        serde_json::from_str(text).map_err(|why| Refusal::unreadable(format!("the question cannot be read: {why}")))?;
    // after a panic, no data of the question is used again
    match catch_unwind(AssertUnwindSafe(|| ask(&question, numbers, progress))) {
        Ok(answer) => answer.map_err(Refusal::from),
        Err(panic) => {
            let message = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
            Err(internal(message.unwrap_or("a fault of this library")))
        }
    }
}

fn internal(what: &str) -> Refusal {
    Refusal { kind: "internal", problems: vec![format!("{what}: please report it with the question").into()] }
}

fn reply(answer: Result<serde_json::Value, Refusal>, warnings: &[String]) -> *mut c_char {
    let value = match answer {
        Ok(answer) => json!({"answer": answer, "warnings": warnings}),
        Err(Refusal { kind, problems }) => json!({"kind": kind, "problems": problems, "warnings": warnings}),
    };
    // JSON escapes zero bytes, so the text contains none
    CString::new(value.to_string()).map_or(ptr::null_mut(), CString::into_raw)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(question: *const c_char, progress: bd_progress) -> serde_json::Value {
        let reply = unsafe { bd_ask(question, ptr::null(), 0, progress, ptr::null_mut()) };
        let text = unsafe { CStr::from_ptr(reply) }.to_str().expect("UTF-8").to_owned();
        unsafe { bd_free(reply) };
        serde_json::from_str(&text).expect("JSON")
    }

    fn kind_and_message(question: &CStr) -> (String, String) {
        let reply = asked(question.as_ptr(), None);
        let word = |value: &serde_json::Value| value.as_str().unwrap_or_default().to_owned();
        (word(&reply["kind"]), word(&reply["problems"][0]["message"]))
    }

    #[test]
    fn an_unreadable_question_is_a_problem() {
        for (question, part) in [
            (c"", "EOF"),
            (c"{\"ask\": \"geometry\"", "EOF"),
            (c"[1, 2]", "cannot be read"),
            (c"{\"ask\": \"weather\"}", "weather"),
            (c"{\"ask\": \"geometry\", \"facets\": -1}", "-1"),
            (c"{\"ask\": \"geometry\", \"facets\": 1}", "facets 1: must be"),
            (c"{\"ask\": \"geometry\", \"sat\": []}", "sat"),
            (c"{\"ask\": \"geometry\", \"set\": [\"geometry.module=4 kg\"]}", "units that do: m, mm, um"),
            (c"{\"ask\": \"plan\", \"of\": {\"name\": \"nowhere\"}}", "cannot be read"),
            (c"{\"ask\": \"statistics\", \"points\": 0, \"figures\": []}", "points = 0"),
            (c"\xff", "not UTF-8"),
        ] {
            let (_, message) = kind_and_message(question);
            assert!(message.contains(part), "{question:?}: {message}");
        }
        assert_eq!(asked(ptr::null(), None)["kind"], "use");
        let reply = unsafe { bd_ask(c"{}".as_ptr(), ptr::null(), 3, None, ptr::null_mut()) };
        assert!(!reply.is_null());
        unsafe { bd_free(reply) };
        unsafe { bd_free(ptr::null_mut()) };
    }

    #[test]
    fn a_problem_names_variable_value_unit_and_range() {
        let question = c"{\"ask\": \"geometry\", \"set\": [\"geometry.module=4 km\", \"geometry.modul=1\"]}";
        let reply = asked(question.as_ptr(), None);
        let problems = &reply["problems"];
        assert_eq!(problems[0]["variable"], "geometry.module");
        assert_eq!((&problems[0]["value"], &problems[0]["unit"]), (&json!("\"4 km\""), &json!("m")));
        assert_eq!(problems[0]["range"].as_array().map(Vec::len), Some(2));
        assert_eq!(problems[1]["hint"], "geometry.module");
    }

    #[test]
    fn the_caller_can_stop_the_work() {
        unsafe extern "C" fn stop(_: *mut c_void, _: f64, _: *const c_char) -> c_int {
            1
        }
        let reply = asked(c"{\"ask\": \"geometry\"}".as_ptr(), Some(stop));
        assert_eq!(reply["kind"], "stopped");
    }
}
