from .batch import integrate_batch as integrate_batch
from .integration import MemberResponses as MemberResponses
from .integration import Members as Members
from .integration import integrate as integrate
from .integration import integrate_members as integrate_members
from .response import Response as Response
