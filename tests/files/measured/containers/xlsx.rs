//! Workbooks of Mitutoyo: a profile of three points that are not even, the second one without a height.

use super::zipped;

/// The workbook whose second sheet has a name.
pub fn workbook(name: &str) -> Vec<u8> {
    archive(name, &data())
}

/// The cells of the data.
pub fn data() -> String {
    let rows = [
        "<c r=\"A1\" t=\"s\"><v>1</v></c><c r=\"E1\"><v>0.001</v></c><c r=\"F1\"><v>1</v></c>",
        "<c r=\"AE2\"><v>7</v></c><c r=\"E2\"><v>0.002</v></c><c r=\"F2\" t=\"e\"><v>#N/A</v></c>",
        "<c r=\"E3\"><v>0.004</v></c><c r=\"F3\"><v>3</v></c><c r=\"G3\"><v>9</v></c>",
        "<c r=\"F4\"/>",
    ];
    rows.map(|row| format!("<row>{row}</row>")).concat()
}

/// The workbook whose second sheet has a name and cells.
pub fn archive(name: &str, cells: &str) -> Vec<u8> {
    let space = "xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\"";
    let workbook = format!(
        "<workbook {space}><sheets><sheet name=\"Certificate\" sheetId=\"1\" r:id=\"rId1\"/>\
         <sheet name=\"{name}\" sheetId=\"2\" r:id=\"rId2\"/></sheets></workbook>"
    );
    let links = "<Relationships><Relationship Id=\"rId2\" Target=\"worksheets/sheet2.xml\"/>\
                 <Relationship Id=\"rId1\" Target=\"/xl/worksheets/sheet1.xml\"/></Relationships>";
    let texts = "<sst><si><t>0.08mm</t></si><si><r><t>Ra  0.018</t></r><r><t>  µm </t></r></si></sst>";
    let certificate = "<worksheet><sheetData><row><c r=\"E2\" t=\"inlineStr\"><is><t>22- Nov -2026</t></is></c></row>\
                       <row><c r=\"E48\" t=\"s\"><v>0</v></c></row></sheetData></worksheet>";
    let data = format!("<worksheet><sheetData>{cells}</sheetData></worksheet>");
    zipped(&[
        ("xl/workbook.xml", workbook.as_bytes()),
        ("xl/_rels/workbook.xml.rels", links.as_bytes()),
        ("xl/sharedStrings.xml", texts.as_bytes()),
        ("xl/worksheets/sheet1.xml", certificate.as_bytes()),
        ("xl/worksheets/sheet2.xml", data.as_bytes()),
    ])
}

pub fn file() -> Vec<u8> {
    workbook("DATA")
}
