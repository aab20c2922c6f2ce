"""Contacts: stacks of rigid courses whose contacts open, close and slide."""
