//! Memory that this process may have, where the system tells.

use std::fs;
use std::path::Path;

/// Bytes: what the machine has, or less where a batch system, a container or `ulimit -v` gives less.
pub fn at_hand() -> Option<f64> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_default(); // not Linux: nothing is known
    let groups = groups(&read("/proc/self/cgroup"));
    let limits = groups.iter().filter_map(|path| bytes(&fs::read_to_string(path).ok()?));
    let own = [total(&read("/proc/meminfo")), address_space(&read("/proc/self/limits"))];
    limits.chain(own.into_iter().flatten()).min_by(f64::total_cmp)
}

/// The memory of the machine, of `/proc/meminfo`.
fn total(meminfo: &str) -> Option<f64> {
    let total = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    Some(1024.0 * total.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
}

/// The soft limit on the address space, of `/proc/self/limits`.
fn address_space(limits: &str) -> Option<f64> {
    bytes(limits.lines().find_map(|line| line.strip_prefix("Max address space"))?.split_whitespace().next()?)
}

/// A limit in bytes; none for `max` and `unlimited`.
fn bytes(text: &str) -> Option<f64> {
    text.trim().parse().ok()
}

/// The files with the limits of the control groups that the process is in, of `/proc/self/cgroup`: its own and those around it. In a
/// container some are not there.
fn groups(cgroup: &str) -> Vec<String> {
    let mut files = Vec::new();
    for line in cgroup.lines() {
        let (root, file) = match line.split(':').nth(1) {
            Some("") => ("/sys/fs/cgroup", "memory.max"),
            Some(kinds) if kinds.split(',').any(|kind| kind == "memory") => {
                ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
            }
            _ => continue,
        };
        let own = line.splitn(3, ':').nth(2).unwrap_or("/");
        files.extend(Path::new(own).ancestors().map(|group| format!("{root}{}/{file}", group.display())));
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_memory_of_a_machine_is_read_or_unknown() {
        assert_eq!(total("MemTotal:       24683820 kB\nMemFree: 1 kB\n"), Some(24_683_820.0 * 1024.0));
        for text in ["", "MemFree: 1 kB", "MemTotal: much", "MemTotal: many kB"] {
            assert_eq!(total(text), None, "{text}");
        }
    }

    #[test]
    fn limits_are_read_or_unknown() {
        let limits = "Limit                     Soft Limit           Hard Limit           Units\n\
                      Max address space         4096000000           unlimited            bytes\n";
        assert_eq!(address_space(limits), Some(4.096e9));
        assert_eq!(address_space(&limits.replace("4096000000", "unlimited ")), None);
        assert_eq!([bytes("200000000\n"), bytes("max\n")], [Some(2e8), None]);
    }

    #[test]
    fn groups_around_the_own_one_count() {
        let second =
            ["/sys/fs/cgroup/a/b/memory.max", "/sys/fs/cgroup/a/memory.max", "/sys/fs/cgroup//memory.max"];
        assert_eq!(groups("0::/a/b\n"), second);
        let first = [
            "/sys/fs/cgroup/memory/job/memory.limit_in_bytes",
            "/sys/fs/cgroup/memory//memory.limit_in_bytes",
        ];
        assert_eq!(groups("7:cpu,memory:/job\n3:pids:/job\n"), first);
        assert!(groups("").is_empty());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_tells() {
        assert!(at_hand().is_some_and(|bytes| bytes > 1e6));
    }
}
