"""The ontology of Heron."""

from pathlib import Path

from ezskiros.ontology import load

heron = load(Path(__file__).with_name("heron.ttl")).heron
