// Unpacks Chromium below this folder and prints its path.
//
// The package brings the libraries that a bare machine lacks: NSS, NSPR and expat, built for Amazon Linux 2023.
import { existsSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";

if (`${process.platform} ${process.arch}` !== "linux x64") throw new Error("npm has Chromium for Linux on x86-64 only");
const folder = fileURLToPath(new URL("node_modules/.chromium", import.meta.url));
mkdirSync(folder, { recursive: true });
// Where the package unpacks to, and what makes it unpack its libraries too.
process.env.TMPDIR = folder;
process.env.AWS_LAMBDA_JS_RUNTIME = "nodejs22.x";
const { default: chromium } = await import("@sparticuz/chromium");
const path = await chromium.executablePath();
if (!existsSync(path)) throw new Error(`${path}: Chromium was not unpacked`);
console.log(path);
