//! tmp
fn main() {
    let name = std::env::args().nth(1).unwrap();
    let text = if name.ends_with("json") {
        std::fs::read_to_string(&name).unwrap()
    } else {
        hw_model::presets::find(&name).unwrap().json.to_owned()
    };
    let design =
        hw_model::design::Design::new(hw_model::config::Config::from_json(&text).unwrap()).unwrap();
    print!("{}", vectors::rtl::package(&design, "x"));
}
