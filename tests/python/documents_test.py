"""What documents show in Python, and what `veduta info` says of a file."""

import json
import os
import re
import unittest

import h5py

from toy import answers, output_of, source, toy, veduta, work


class Documents(unittest.TestCase):
    def snippet(self, document):
        """The Python of a document, as it stands there."""
        text = (source / document).read_text()
        blocks = re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
        self.assertTrue(blocks, document)
        return "\n".join(blocks)

    def run_in_work(self, code):
        names, before = {}, os.getcwd()
        try:
            os.chdir(work)
            exec(code, names)
        finally:
            os.chdir(before)
        return names

    def test_examples_of_the_documents_read_a_row(self):
        answer = answers[toy]
        for document in ("README.md", "docs/format.md"):
            names = self.run_in_work(self.snippet(document))
            row = answer["rows"][42]
            self.assertEqual([name.decode() for name in names["visible"]], [answer["names"][e[0]] for e in row])
            self.assertEqual(names["index"].tolist(), [e[1:4] for e in row], document)

    def test_info_has_the_figures_of_the_datasets(self):
        for path, answer in answers.items():
            info = json.loads(output_of(veduta, "info", path, "--json"))
            rows = answer["rows"]
            self.assertEqual((info["cells"], info["objects"]), (len(rows), len(answer["names"])))
            self.assertAlmostEqual(info["visible_objects_mean"], sum(map(len, rows)) / len(rows))
            with h5py.File(path) as file:
                stored = {"/" + name: file[name].id.get_storage_size()
                          for name in ["cells/row"] + ["pvs/" + name for name in file["pvs"]]}
            self.assertEqual(info["pvs_bytes_of"], stored)
            self.assertAlmostEqual(info["pvs_bytes_per_cell"], sum(stored.values()) / len(rows))
            self.assertEqual(info["other_codings_bytes_per_cell"]["three_bytes"], 3 * len(answer["names"]))
