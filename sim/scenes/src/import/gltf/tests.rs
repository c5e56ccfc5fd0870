use super::material::exponent;
use super::*;
use crate::import::UpAxis;

fn wish() -> Wish {
    Wish { name: "model".into(), mesh: "model.obj".into(), size: (64, 48), up: UpAxis::Y }
}

/// A tetrahedron's three faces around a corner, under a node that moves and stretches it.
fn document(extra: &str, indices: &[u16]) -> String {
    let positions: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut bytes: Vec<u8> = positions.iter().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
    let data: String = bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    let (all, count) = (bytes.len(), indices.len());
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0, "translation": [10, 0, 0], "scale": [1, 2, 1]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}],
        "buffers": [{{"byteLength": {all}, "uri": "data:application/octet-stream,{data}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}},
                        {{"buffer": 0, "byteOffset": 48, "byteLength": {}}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                        "min": [0, 0, 0], "max": [1, 1, 1]}},
                      {{"bufferView": 1, "componentType": 5123, "count": {count}, "type": "SCALAR"}}],
        "materials": [{{"name": "a # b", "pbrMetallicRoughness":
                        {{"baseColorFactor": [1, 0.5, 0, 1], "metallicFactor": 0.5,
                          "roughnessFactor": 0.5}}}}]{extra}}}"#,
        2 * count
    )
}

fn import(text: &str) -> Result<Imported, ImportError> {
    gltf(&wish(), text.as_bytes(), &mut |_| Err(io::ErrorKind::NotFound.into()))
}

#[test]
fn triangles_stand_where_their_node_puts_them() {
    let made = import(&document("", &[0, 2, 1, 0, 1, 3, 0, 0, 1])).unwrap();
    let mesh = Mesh::read(made.mesh.as_ref().unwrap(), Normals::Flat).unwrap();
    assert_eq!(mesh.triangles.len(), 2);
    assert_eq!(mesh.triangles[0].corners[1], crate::scene::Vector::new(10.0, 2.0, 0.0));
    assert_eq!(made.remarks, ["left out: 1 triangles without area"]);
}

#[test]
fn a_material_follows_its_roughness() {
    let made = import(&document("", &[0, 2, 1])).unwrap();
    let material = &made.description.materials[0];
    assert_eq!((material.name.as_str(), material.exponent), ("a b", 30.0));
    assert_eq!(material.diffuse, [0.5, 0.25, 0.0]);
    assert_eq!(material.specular, [0.52, 0.27, 0.02]);
    assert_eq!([1.0, 0.25, 0.0].map(exponent), [0.0, 510.0, f64::INFINITY]);
}

#[test]
fn glossiness_counts_before_roughness() {
    let extension = r#""extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0.25, 0, 1],
        "specularFactor": [1, 0.5, 0.25], "glossinessFactor": 0.5}}, "name""#;
    let text = document(r#", "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"]"#, &[0, 2, 1]);
    let made = import(&text.replace("\"name\"", extension)).unwrap();
    let material = &made.description.materials[0];
    // Glossiness 1/2 is roughness 1/2: α = 1/4, and n = 2·16 − 2.
    assert_eq!((material.exponent, made.treated[0].said.as_str()), (30.0, "glossiness 0.5"));
    assert_eq!((material.diffuse, material.specular), ([0.5, 0.25, 0.0], [1.0, 0.5, 0.25]));
}

#[test]
fn damaged_documents_are_refused() {
    let good = document("", &[0, 2, 1]);
    for (from, to, says) in [
        ("\"count\": 4", "\"count\": 400", "beyond the end"),
        ("\"count\": 4", "\"count\": 4000000000", "too many"),
        ("\"POSITION\": 0", "\"POSITION\": 7", "accessor 7 does not exist"),
        ("5126", "5121", "32-bit floats"),
        ("5123, \"count\": 3, \"type\": \"SCALAR\"", "5126, \"count\": 1, \"type\": \"SCALAR\"", "whole numbers"),
        ("\"scale\": [1, 2, 1]", "\"children\": [0]", "below itself"),
        ("\"byteLength\": 54", "\"byteLength\": 55", "54 bytes"),
        ("data:application/octet-stream,", "there/is none", "buffer 0: "),
        ("[10, 0, 0]", "[1e30, 0, 0]", "out of range"),
        ("\"version\": \"2.0\"", "\"version\": 2", "invalid type"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = import(&good.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains(says), "{from}: {error}");
    }
    let error = import(&document("", &[0, 2, 9])).unwrap_err().to_string();
    assert!(error.contains("index 9"), "{error}");
}
