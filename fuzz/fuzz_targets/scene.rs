#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| curveflow_tests::hostile::scene(bytes));
