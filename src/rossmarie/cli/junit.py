"""The results of tests in the XML format of JUnit, which build servers read."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from rossmarie.driver.testing import RanTests


def junit_text(tested: RanTests) -> str:
    """A test suite with a case for each test. A failed case contains its findings."""
    failed = sum(bool(ran.found) for ran in tested.ran)
    attributes = {"name": "rossmarie", "tests": str(len(tested.ran)), "failures": str(failed)}
    suite = ET.Element("testsuite", attributes)
    for ran in tested.ran:
        case = ET.SubElement(suite, "testcase", name=ran.script.name, time=f"{ran.seconds:.3f}")
        for finding in ran.found:
            failure = ET.SubElement(case, "failure", message=finding.title)
            failure.text = "\n".join((str(finding.primary.span), *finding.notes))
    ET.indent(suite)
    return ET.tostring(suite, encoding="unicode", xml_declaration=True) + "\n"
