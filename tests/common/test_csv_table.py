"""Tables as people and their spreadsheets write them."""

import pytest

from rover_common.csv_table import CellError, TableError, read_table


def table(folder, text, encoding="utf-8", **options):
    path = folder / "table.csv"
    path.write_text(text, encoding=encoding, newline="")
    return read_table(path, ("x", "y"), **options)


@pytest.mark.parametrize(
    "text",
    [
        "x,y\n1.5,2.5\n",
        "\ufeffx,y\n1.5,2.5\n",
        "x, y\n 1.5, 2.5 \n",
        "X,Y\n1.5,2.5\n",
        "x;y\n1,5;2,5\n",
        "x\ty\n1,5\t2.5\n",
        "x,y\r\n1.5,2.5\r\n",
        "x,y\r1.5,2.5",
        "\n\nx,y\n\n1.5,2.5\n\n",
        "# x,y\n1.5,2.5\n",
        'y,"x"\n2.5,"1.5"\n',
        "name,y,x,,\na,2.5,1.5,,\n",
        "x,y\n1.5,2.5,,\n",
        "x,y\n1.5\0,2.5\n",
    ],
    ids=repr,
)
def test_the_forms_of_a_table_are_read_alike(tmp_path, text):
    (row,) = table(tmp_path, text)
    assert (row.number("x"), row.number("y")) == (1.5, 2.5)


def test_utf_16_of_a_spreadsheet_is_read(tmp_path):
    (row,) = table(tmp_path, "x\ty\r\n1,5\t2,5\r\n", "utf-16")
    assert (row.number("x"), row.number("y")) == (1.5, 2.5)


@pytest.mark.parametrize("text", ["", "\n \n", "1.5,2.5\n", "a,b\n1,2\n", "x\n1\n"])
def test_no_header_is_refused_with_the_line(tmp_path, text):
    with pytest.raises(TableError, match=r"table\.csv: line 1: .*columns x, y"):
        table(tmp_path, text)


@pytest.mark.parametrize("cells", ["nan,1", "inf,1", "far,1", ",1", "1", "1,2,3", "1.2.3,1"])
def test_a_bad_row_names_its_line(tmp_path, cells):
    rows = table(tmp_path, f"x,y\n1,2\n\n{cells}\n5,6\n")
    assert [row.line for row in rows] == [2, 4, 5]
    with pytest.raises(CellError, match="line 4: "):
        rows[1].number("x")
    assert rows[2].number("y") == 6.0  # the rows around it are whole


def test_a_quote_that_nobody_closed_ends_with_its_line(tmp_path):
    rows = table(tmp_path, 'x,y\n"1,2\n3,4\n')
    assert rows[1].number("x") == 3.0


def test_a_cell_of_any_length_is_read(tmp_path):
    (row,) = table(tmp_path, "x,y,name\n1,2," + "a" * 200_000 + "\n")
    assert row.number("y") == 2.0


def test_the_text_takes_the_cells_that_are_too_many(tmp_path):
    (row,) = table(tmp_path, "x,path,y\n1,a,b,c,2\n", text_column="path")
    assert row.text("path") == "a,b,c"
    assert (row.number("x"), row.number("y")) == (1.0, 2.0)


def test_a_header_in_the_middle_begins_a_new_part(tmp_path):
    rows = table(tmp_path, "x,y\n1,2\ny,x\n4,3\n")
    assert [(row.number("x"), row.number("y")) for row in rows] == [(1.0, 2.0), (3.0, 4.0)]
