//! Gives the shared library its name for the loader, which ends in the version of the ABI: a program that was linked
//! against one ABI does not start with another.

include!("src/abi.rs");

fn main() {
    println!("cargo:rerun-if-changed=src/abi.rs");
    println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libblysk.so.{ABI_VERSION}");
}
