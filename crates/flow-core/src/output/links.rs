//! Where a symbolic link leads, for all who name files after the one that it stands for.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// As many links as Linux follows.
const MOST_LINKS: usize = 40;

/// The file that `path` is another name of, which need not exist yet; `path` itself if it is no link. Of links that lead
/// nowhere, since they go round in circles, one of them.
pub(super) fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let Ok(target) = fs::read_link(&path) else { break };
        path = path.parent().map_or_else(|| target.clone(), |folder| folder.join(&target));
    }
    path
}

/// A file beside the one that `path` is a name of, whose name has `suffix` added.
pub(super) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(followed(path));
    name.push(suffix);
    PathBuf::from(name)
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn links_are_followed_to_files_that_are_not_there_yet() {
        let folder = std::env::temp_dir().join(format!("curveflow-links-{}", std::process::id()));
        fs::create_dir_all(folder.join("real")).unwrap();
        symlink("real/out.h5", folder.join("second")).unwrap();
        symlink(folder.join("second"), folder.join("first")).unwrap();
        symlink("circle", folder.join("circle")).unwrap();
        let followed = ["first", "second", "circle", "none"].map(|name| followed(&folder.join(name)));
        let lock = beside(&folder.join("first"), ".lock");
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(followed, ["real/out.h5", "real/out.h5", "circle", "none"].map(|name| folder.join(name)));
        assert_eq!(lock, folder.join("real/out.h5.lock"));
    }
}
