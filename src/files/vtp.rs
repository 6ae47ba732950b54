//! VTP: VTK XML poly data for ParaView, written whole, arrays as base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// Points with values, and the lines or polygons between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PolyData {
    /// Places, m.
    pub points: Vec<[f64; 3]>,
    /// Corners of each line.
    pub lines: Vec<[u32; 2]>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Values at points: name with unit, numbers in one tuple a point.
    pub point_data: Vec<Column>,
    /// Values of cells: points as vertices if there is nothing else, or lines, or triangles.
    pub cell_data: Vec<Column>,
}

/// A named array.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name with unit.
    pub name: &'static str,
    /// Numbers in a tuple: 1 or 3.
    pub components: usize,
    /// Values, tuple after tuple.
    pub values: Vec<f64>,
}

impl Column {
    /// One number a point or cell.
    #[must_use]
    pub fn scalars(name: &'static str, values: Vec<f64>) -> Self {
        Self {
            name,
            components: 1,
            values,
        }
    }

    /// One vector a point or cell.
    #[must_use]
    pub fn vectors(name: &'static str, values: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self {
            name,
            components: 3,
            values: values.into_iter().flatten().collect(),
        }
    }
}

impl PolyData {
    /// The file's text.
    #[must_use]
    pub fn text(&self) -> String {
        let vertices = if self.lines.is_empty() && self.triangles.is_empty() {
            self.points.len()
        } else {
            0
        };
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{vertices}\" \
             NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
            self.points.len(),
            self.lines.len(),
            self.triangles.len(),
        );
        columns(&mut text, "PointData", &self.point_data);
        columns(&mut text, "CellData", &self.cell_data);
        columns(
            &mut text,
            "Points",
            &[Column::vectors("Points", self.points.iter().copied())],
        );
        let every_point: Vec<[u32; 1]> = (0..vertices as u32).map(|i| [i]).collect();
        cells(&mut text, "Verts", &every_point);
        cells(&mut text, "Lines", &self.lines);
        cells(&mut text, "Polys", &self.triangles);
        text.push_str("</Piece>\n</PolyData>\n</VTKFile>\n");
        text
    }
}

fn columns(text: &mut String, section: &str, columns: &[Column]) {
    let _ = writeln!(text, "<{section}>");
    for column in columns {
        let bytes = column.values.iter().flat_map(|v| v.to_le_bytes()).collect();
        array(text, "Float64", column.name, column.components, bytes);
    }
    let _ = writeln!(text, "</{section}>");
}

fn cells<const N: usize>(text: &mut String, section: &str, cells: &[[u32; N]]) {
    let _ = writeln!(text, "<{section}>");
    let corners = cells
        .iter()
        .flatten()
        .flat_map(|&i| i64::from(i).to_le_bytes())
        .collect();
    array(text, "Int64", "connectivity", 1, corners);
    let ends = (1..=cells.len())
        .flat_map(|i| ((i * N) as i64).to_le_bytes())
        .collect();
    array(text, "Int64", "offsets", 1, ends);
    let _ = writeln!(text, "</{section}>");
}

fn array(text: &mut String, kind: &str, name: &str, components: usize, data: Vec<u8>) {
    let mut bytes = (data.len() as u64).to_le_bytes().to_vec();
    bytes.extend(data);
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">\n{}\n</DataArray>",
        STANDARD.encode(bytes)
    );
}

/// Collection that gives files of a series their times.
#[must_use]
pub fn collection(frames: &[(f64, String)]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
    );
    for (time, file) in frames {
        let _ = writeln!(text, "<DataSet timestep=\"{time:e}\" file=\"{file}\"/>");
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use vtkio::model::{DataSet, Piece, Vtk};

    #[test]
    fn another_reader_finds_the_points_and_lines_written() {
        let data = PolyData {
            points: vec![[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0]],
            lines: vec![[0, 1]],
            cell_data: vec![Column::scalars("force_N", vec![2.5])],
            ..PolyData::default()
        };
        let vtk = Vtk::parse_xml(data.text().as_bytes()).unwrap();
        let DataSet::PolyData { pieces, .. } = vtk.data else {
            panic!("not poly data")
        };
        let Piece::Inline(piece) = &pieces[0] else {
            panic!("not inline")
        };
        let points: Vec<f64> = piece.points.cast_into().unwrap();
        assert_eq!(points, [1.0, 2.0, 3.0, -1.0, 0.5, 0.0]);
        assert_eq!(piece.lines.as_ref().unwrap().num_cells(), 1);
    }
}
