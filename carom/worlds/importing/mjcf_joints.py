"""Joints, actuators and equalities of MJCF as freedoms and connections."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.ecs.spatial import quaternion
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.mjcf_file import Compiler, Defaults
from carom.worlds.importing.model import SLIDE, TURN, Connection, Freedom, Link
from carom.worlds.importing.report import Report

TYPES = ("hinge", "slide", "ball", "free")
SOFTNESS = ("solreflimit", "solimplimit", "solreffriction", "solimpfriction", "margin", "springdamper")


class Joints:
    """Reads joints; ``named`` are their freedoms with the value that each calls 0 here, for actuators."""

    def __init__(self, compiler: Compiler, defaults: Defaults, reading: Reading, report: Report) -> None:
        self.compiler, self.defaults, self.reading, self.report = compiler, defaults, reading, report
        self.named: dict[str, tuple[Freedom, float]] = {}

    def connection(self, elements: list[Element], carrier: str | None, link: Link) -> Connection | None:
        """Return what holds a link by its joints, one after another; None where nothing does."""
        types = [self.reading.choice(element, "type", TYPES, "hinge") for element in elements]
        name = elements[0].attributes.get("name") or f"{link.name}-joint"
        if "free" in types or "ball" in types:
            if len(elements) > 1:
                self.reading.fault(elements[0], "a free or ball joint is not alone", received=", ".join(types))
            return None if "free" in types else self.ball(elements[0], name, carrier, link)
        connection = Connection(elements[0], name, carrier, link.name)
        for element, kind in zip(elements, types, strict=True):
            connection.freedoms.append(self.freedom(element, kind, link))
        return connection

    def ball(self, element: Element, name: str, carrier: str | None, link: Link) -> Connection:
        """Return a ball; what its range allows as a whole here bounds the angle between the axes."""
        at = link.pose.point(self.reading.numbers(element, "pos", 3, (0.0, 0.0, 0.0)))
        connection = Connection(element, name, carrier, link.name, at=at, ball=True)
        if self.limited(element):
            greatest = self.compiler.angle(self.reading.numbers(element, "range", 2)[1])
            connection.swing = min(greatest, math.pi)
            if greatest <= 0.0:
                received = element.attributes.get("range", "")
                self.reading.fault(element, "a ball has no range to move in", received=received)
            self.report.approximate(element, "the range of a ball, as its swing without its twist", name)
        for key in ("damping", "stiffness"):
            if self.reading.numbers(element, key, 1, (0.0,))[0]:
                self.report.drop(element, f"{key} of a ball", name)
        self.leavings(element, name)
        return connection

    def freedom(self, element: Element, kind: str, link: Link) -> Freedom:
        """Return a hinge or slide; its values here are less by its reference, which is where it is at first."""
        read, name = self.reading, element.attributes.get("name", link.name)
        scale = 1.0 if kind == "slide" else self.compiler.degree
        axis = np.array(read.numbers(element, "axis", 3, (0.0, 0.0, 1.0)))
        if not axis.any():
            read.fault(element, "axis has no direction", received="0 0 0")
            axis = np.array((0.0, 0.0, 1.0))
        at = link.pose.point(read.numbers(element, "pos", 3, (0.0, 0.0, 0.0)))
        axis = quaternion.rotate(link.pose.rotation, axis / np.sqrt((axis * axis).sum()))
        reference = scale * read.number(element, "ref", 0.0)
        freedom = Freedom(SLIDE if kind == "slide" else TURN, at, axis)
        if self.limited(element):
            lower, upper = (scale * value - reference for value in read.numbers(element, "range", 2))
            if lower > upper:
                received = element.attributes["range"]
                read.fault(element, "the lower limit must not be above the upper", received=received)
            freedom.limits = (lower, upper)
        freedom.damping = read.number(element, "damping", 0.0, least=0.0)
        freedom.friction = read.number(element, "frictionloss", 0.0, least=0.0)
        freedom.stiffness = read.number(element, "stiffness", 0.0, least=0.0)
        freedom.target = scale * read.number(element, "springref", 0.0) - reference
        self.leavings(element, name)
        self.named[name] = freedom, reference
        return freedom

    def limited(self, element: Element) -> bool:
        """Tell whether the range of a joint counts."""
        stated = self.reading.choice(element, "limited", ("auto", "true", "false"), "auto")
        return stated == "true" or (
            stated == "auto" and self.compiler.limits_by_range and "range" in element.attributes
        )

    def leavings(self, element: Element, name: str) -> None:
        """Note what of a joint does not come over."""
        if self.reading.number(element, "armature", 0.0):
            self.report.drop(element, "armature, the inertia of a rotor", name)
        for key in SOFTNESS:
            if key in element.attributes:
                self.report.drop(element, f"softness of joints ({key})", name)

    def actuator(self, stated: Element) -> None:
        """Let a servo act on its joint, its command being 0; others do nothing without a program."""
        element = self.defaults.filled(stated, "main")
        words, read = element.attributes, self.reading
        name = words.get("name") or words.get("joint") or element.tag
        if element.tag not in ("position", "velocity"):
            self.report.drop(element, f"actuators <{element.tag}>, which push as a program commands", name)
            return
        if words.get("joint") not in self.named:
            self.report.drop(element, "actuators of what is no hinge or slide", name)
            return
        freedom, reference = self.named[words["joint"]]
        gear = read.numbers(element, "gear", 6, (1.0,), fewer=True)[0]
        damping = read.number(element, "kv", 1.0 if element.tag == "velocity" else 0.0) * gear * gear
        stiffness = read.number(element, "kp", 1.0) * gear * gear if element.tag == "position" else 0.0
        if "forcerange" in words:
            low, high = read.numbers(element, "forcerange", 2)
            if freedom.damping or freedom.stiffness:
                self.report.drop(element, "the forcerange of a servo beside other springs and dampers", name)
            elif high > 0.0:
                freedom.most = high
                if low != -high:
                    self.report.approximate(element, "a forcerange that is not the same both ways", name)
        total = freedom.stiffness + stiffness
        if stiffness:
            freedom.target = (freedom.stiffness * freedom.target - stiffness * reference) / total
        freedom.stiffness, freedom.damping = total, freedom.damping + damping
        self.report.keep("servo")

    def equality(self, stated: Element, links: dict[str, Link]) -> Connection | None:
        """Return a connect as a ball and a weld as a fixed joint."""
        element = self.defaults.filled(stated, "main")
        words, read = element.attributes, self.reading
        name = words.get("name") or element.tag
        if element.tag not in ("connect", "weld") or words.get("active") == "false" or "body1" not in words:
            self.report.drop(element, f"equalities <{element.tag}>" + " at sites" * ("site1" in words), name)
            return None
        one = self.known(element, "body1", links)
        other = self.known(element, "body2", links) if "body2" in words else None
        if one is None or ("body2" in words and other is None):
            return None
        if "relpose" in words:
            self.report.drop(element, "the relpose of a weld, which holds as it stands", name)
        for key in ("solref", "solimp", "torquescale"):
            if key in words:
                self.report.drop(element, f"softness of equalities ({key})", name)
        ball = element.tag == "connect"
        at = one.pose.point(read.numbers(element, "anchor", 3, None if ball else (0.0, 0.0, 0.0)))
        return Connection(element, name, None if other is None else other.name, one.name, at=at, ball=ball)

    def exclusion(self, element: Element, links: dict[str, Link]) -> Connection | None:
        """Return what lets two bodies pass through each other."""
        one, other = (self.known(element, key, links) for key in ("body1", "body2"))
        if one is None or other is None:
            return None
        name = element.attributes.get("name") or f"{one.name}-{other.name}"
        return Connection(element, name, one.name, other.name, at=one.pose.position, apart=True)

    def known(self, element: Element, key: str, links: dict[str, Any]) -> Link | None:
        """Return a body by name; an unknown one is a fault."""
        name = self.reading.text(element, key)
        if name not in links:
            accepted = ", ".join(list(links)[:12])
            self.reading.fault(element, f"{key} is no body", received=repr(name), accepted=accepted)
        return links.get(name)
